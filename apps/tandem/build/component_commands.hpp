// SPDX-License-Identifier: Apache-2.0
// Shared parts of the command lines of `tandem opros` and `tandem rtm`.
#pragma once

#include "apps/tandem/build/plugin_build.hpp"
#include "apps/tandem/commands.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Adds --plugin-path: folders to search before the default ones.
void add_plugin_path(CLI::App* command, std::vector<std::filesystem::path>& folders);

/// Adds an option that takes a time between 0.1 s and an hour.
void add_seconds(CLI::App* command, const char* name, double& seconds, const char* description);

/// Adds --initialize, --timeout and --json of a command that creates components to see their ports.
void add_inspection_options(CLI::App* command, bool& initialize, double& timeout_s, bool& json);

/// Adds DIR and the options of a build. `output_help`: the help text of --output.
void add_build_options(CLI::App* command, PluginBuildOptions& options, const char* output_help);

/// Creates the folder parent/name with a component that builds, and returns the exit code.
using CreateComponent = int (*)(const std::string& name, const std::filesystem::path& parent);

/// Adds the sub-command `new NAME [--in DIR]`, which runs `create`.
void add_new_command(CLI::App& parent, const char* brief, const char* details, CreateComponent create,
                     Action& selected);

} // namespace tandem::command
