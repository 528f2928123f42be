// SPDX-License-Identifier: Apache-2.0
// Configures the CMake projects of components to learn what their targets compile.
#pragma once

#include "apps/tandem/build/build_folder.hpp"
#include "apps/tandem/build/project/codemodel.hpp"

#include <map>
#include <optional>

namespace tandem::command {

/// Configures each project at most once. This executes the CMake code of the project, without network, and writes
/// only below `build` unless that code does otherwise.
class CMakeProjects {
  public:
    /// `build`: the parent of the scratch folders; "": a temporary folder, removed with this object.
    CMakeProjects(std::filesystem::path build, double timeout_s);

    /// Returns a target that compiles one of the sources. Prefers plugins to programs, and targets named `name`.
    /// Searches the nearest project above the sources, then the outermost one of the checkout.
    std::optional<ProjectTarget> find_target(const std::filesystem::path& folder,
                                             const std::vector<std::filesystem::path>& sources,
                                             const std::string& name);

    /// Returns what the projects lacked, for an error message: the error of CMake, or missing packages; "": nothing.
    std::string problem() const;

    /// Forgets what the projects lacked and compile: they are configured again.
    void forget() { projects_.clear(); }

  private:
    struct Project {
        std::vector<ProjectTarget> targets;
        std::string problem;
    };
    const Project& configure(const std::filesystem::path& folder);

    std::filesystem::path build_;
    double timeout_s_;
    std::optional<BuildFolder> scratch_;
    std::map<std::filesystem::path, Project> projects_;
};

} // namespace tandem::command
