// SPDX-License-Identifier: Apache-2.0
// Building a plugin from a component's folder: `tandem opros build` and `tandem rtm build` write a CMake project that
// calls the function of the Tandem package, and run CMake on it.
#pragma once

#include "apps/tandem/build/select_sources.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Options that both commands have.
struct PluginBuildOptions {
    std::filesystem::path folder;
    std::filesystem::path output; ///< empty: the default folder of the model
    std::filesystem::path build;  ///< empty: a temporary folder
    std::vector<std::string> include_dirs, definitions, libraries, pkg_config;
    SourceOptions sources;
    int standard = 14;
    std::string build_type = "RelWithDebInfo"; ///< of CMake
    double timeout_s = 600;                    ///< bound for CMake's set-up and for the compilation, each
};

/// Throws std::runtime_error if there is no such folder.
void require_folder(const std::filesystem::path& folder);

/// Builds NAME.so, whose entry point the host looks for, with tandem_add_<model>_component() and puts it into
/// `default_folder`, or into options.output together with the files that CMake has put beside it. An old library is
/// replaced only by a complete new one. Returns its path. Throws std::runtime_error with one line, after the compiler's
/// output has been printed.
std::filesystem::path build_plugin(const std::string& model, const std::string& name,
                                   const EntryPoint& entry_point, const PluginBuildOptions& options,
                                   const std::filesystem::path& default_folder);

} // namespace tandem::command
