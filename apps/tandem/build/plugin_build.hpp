// SPDX-License-Identifier: Apache-2.0
// A component's folder becomes a plugin: `tandem opros build` and `tandem rtm build` write a CMake project of
// one line for it, and have CMake do the work.
#pragma once

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

struct PluginBuildOptions {
    std::filesystem::path folder;
    std::filesystem::path output; ///< empty: where the model keeps its plugins in the folder
    std::filesystem::path build;  ///< empty: a temporary folder
    std::vector<std::string> include_dirs, definitions, libraries;
    int standard = 14;
    double timeout_s = 600; ///< bound for CMake's set-up and for the compilation, each
};

/// DIR and the options that both commands have.
void add_build_options(CLI::App* command, PluginBuildOptions& options, const char* where);

/// Throws std::runtime_error if there is no such folder.
void require_folder(const std::filesystem::path& folder);

/// Builds NAME.so with tandem_add_<model>_component() and puts it into `place`, or into options.output with
/// what CMake lays beside it. The old library is replaced when the new one is whole. Returns its path. Throws
/// std::runtime_error with one line, having printed what the compiler said.
std::filesystem::path build_plugin(const std::string& model, const std::string& name,
                                   const PluginBuildOptions& options,
                                   const std::filesystem::path& default_folder);

} // namespace tandem::command
