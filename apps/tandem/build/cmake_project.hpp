// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/build/include_scan.hpp"
#include "apps/tandem/build/plugin_build.hpp"
#include "apps/tandem/build/select_sources.hpp"

#include <filesystem>
#include <string>

namespace tandem::command {

/// The plugin to build: the component of a model in a folder.
struct Plugin {
    std::string model, name;
    SelectedSources sources;
    std::vector<std::string> definitions; ///< from the component's project files
    NeighbourHeaders neighbours;
    IncludeScan includes;
    bool needs_cv_h =
        false; ///< uses OpenCV's C API through headers that contained it in OpenCV 2 and 3 but not in 4
};

/// Returns the CMakeLists.txt that builds the plugin in the folder `build`. `forwards`: folder of the
/// forwarding headers.
std::string cmake_project(const Plugin& plugin, const PluginBuildOptions& options,
                          const std::filesystem::path& build, const std::filesystem::path& forwards);

} // namespace tandem::command
