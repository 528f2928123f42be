// SPDX-License-Identifier: Apache-2.0
// Selects the sources of a component's plugin.
#pragma once

#include "apps/tandem/build/project/cmake_projects.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

struct SourceOptions {
    std::vector<std::string> sources;  ///< replace the sources found; patterns are allowed
    std::vector<std::string> excluded; ///< names or patterns, relative to the component's folder
};

/// The function that a component's library exports.
struct EntryPoint {
    std::string function;           ///< getComponent, XInit
    std::filesystem::path source{}; ///< defines the function, if several sources do; "": the only one
    /// Functions of the folder's other components. Sources that define one of them are not built, unless a
    /// project file lists them together with this component's source.
    std::vector<std::string> others{};
};

struct SelectedSources {
    std::vector<std::filesystem::path> sources; ///< absolute
    /// In the component's folder, but not listed in `project_files`.
    std::vector<std::filesystem::path> left_out;
    std::string project_files;
    ProjectTarget target; ///< of the component's CMake project; without sources if there is none
};

/// The CMake projects around the component, and the name that its target probably has.
struct ProjectSearch {
    std::string name;
    CMakeProjects& projects;
};

/// Selects the sources of the component in `folder`. A target of a CMake project that compiles the source with the
/// entry point decides. Otherwise they are the sources in the folder, its src/ and beside that source, or those that
/// other project files list together with it. Throws std::runtime_error if there is no source or if several define
/// the entry point.
SelectedSources select_sources(const std::filesystem::path& folder, const EntryPoint& entry_point,
                               const SourceOptions& options, const ProjectSearch& search);

} // namespace tandem::command
