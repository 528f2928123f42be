// SPDX-License-Identifier: Apache-2.0
// What the command lines of `tandem opros` and `tandem rtm` have in common.
#pragma once

#include "apps/tandem/commands.hpp"

#include <filesystem>
#include <string>

namespace tandem::command {

/// Adds a sub-command. `brief`: its line in the parent's help; `details`: the text below its own options.
CLI::App* add_command(CLI::App& parent, const char* name, const char* brief, const char* details);

/// Creates the folder parent/name with a component that builds, and returns the exit code.
using CreateComponent = int (*)(const std::string& name, const std::filesystem::path& parent);

/// Adds the sub-command `new NAME [--in DIR]`, which runs `create`.
void add_new_command(CLI::App& parent, const char* brief, const char* details, CreateComponent create,
                     Action& selected);

} // namespace tandem::command
