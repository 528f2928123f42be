// SPDX-License-Identifier: Apache-2.0
// Builds a plugin from a component's folder for `tandem opros build` and `tandem rtm build`: writes a CMake
// project that calls a function of the Tandem package, and runs CMake.
#pragma once

#include "apps/tandem/build/project/cmake_projects.hpp"
#include "apps/tandem/build/select_sources.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Options of both commands.
struct PluginBuildOptions {
    std::filesystem::path folder;
    std::filesystem::path output; ///< empty: the default folder of the model
    std::filesystem::path build;  ///< empty: a temporary folder
    std::vector<std::string> include_dirs, definitions, libraries, pkg_config;
    SourceOptions sources;
    int standard = 0;                          ///< of C++; 0: the project's, at least 14
    std::string build_type = "RelWithDebInfo"; ///< for CMake
    double timeout_s = 600;                    ///< separate limits for configuring and compiling
};

/// Throws std::runtime_error if the folder does not exist.
void require_folder(const std::filesystem::path& folder);

/// Builds NAME.so with tandem_add_<model>_component(). `entry_point`: the function that the host looks up.
/// Puts the library into `default_folder`, or into options.output together with the other files that CMake
/// made. Replaces an old library only by a complete new one. Returns the path. Throws std::runtime_error with
/// one line after printing the compiler's output.
std::filesystem::path build_plugin(const std::string& model, const std::string& name,
                                   const EntryPoint& entry_point, const PluginBuildOptions& options,
                                   const std::filesystem::path& default_folder, CMakeProjects& projects);

/// Returns the folder for the projects of a component's folder: kept if the user keeps the build folder.
inline std::filesystem::path projects_folder(const PluginBuildOptions& options) {
    return options.build.empty() ? options.build : options.build / "projects";
}

} // namespace tandem::command
