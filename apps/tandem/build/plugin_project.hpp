// SPDX-License-Identifier: Apache-2.0
// Writes the CMake project that builds a component's plugin.
#pragma once

#include "apps/tandem/build/include_scan.hpp"
#include "apps/tandem/build/packages/installed_library.hpp"
#include "apps/tandem/build/packages/missing_libraries.hpp"
#include "apps/tandem/build/plugin_build.hpp"
#include "apps/tandem/build/select_sources.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tandem::command {

/// The plugin to build: the component of a model in a folder.
struct Plugin {
    std::string model, name, entry_function;
    SelectedSources sources;
    std::vector<std::string> definitions; ///< from the component's project files
    std::string problem;                  ///< of the component's CMake project; "": none
    NeighbourHeaders neighbours;
    IncludeScan includes;
    std::map<std::filesystem::path, InstalledLibrary>
        installed; ///< by the include folder that the compiler does not search
    bool needs_cv_h =
        false; ///< uses OpenCV's C API through headers that contained it in OpenCV 2 and 3 but not in 4
    std::map<std::string, std::string> missing_names{}; ///< with their declarations
    MissingLibraries linked{};                          ///< that the linker has missed
};

inline constexpr char names_header[] = "tandem_missing_names.h"; // beside the forwarding headers

/// Returns the pkg-config modules that the component's includes and missing functions ask for.
std::set<std::string> used_modules(const Plugin& plugin);

/// Returns the include folders of the options and of the component's project.
std::vector<std::filesystem::path> include_dirs(const Plugin& plugin, const PluginBuildOptions& options);

/// Returns the CMakeLists.txt that builds the plugin in the folder `build`. `forwards`: folder of the
/// forwarding headers.
std::string cmake_project(const Plugin& plugin, const PluginBuildOptions& options,
                          const std::filesystem::path& build, const std::filesystem::path& forwards);

} // namespace tandem::command
