// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/build/include_scan.hpp"
#include "apps/tandem/build/plugin_build.hpp"
#include "apps/tandem/build/select_sources.hpp"

#include <filesystem>
#include <string>

namespace tandem::command {

/// What is built: the component of a model in a folder.
struct Plugin {
    std::string model, name;
    SelectedSources sources;
    std::vector<std::string> definitions; ///< those of the component's own project
    NeighbourHeaders neighbours;
    IncludeScan includes;
    bool needs_cv_h =
        false; ///< it uses OpenCV's C API by headers that had it in OpenCV 2 and 3, and have not in 4
};

/// The CMakeLists.txt in the folder `build` that makes the plugin. `forwards`: folder of the headers that stand for others.
std::string cmake_project(const Plugin& plugin, const PluginBuildOptions& options,
                          const std::filesystem::path& build, const std::filesystem::path& forwards);

} // namespace tandem::command
