// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>

#include <string>

namespace tandem::command {

/// A script for bash that completes the command line of `app`: sub-commands, options, and their values where these
/// are files, folders or one of a fixed set. Everything in it comes from the tree of CLI::App, so that a new command
/// or option is completed without further work. Files and folders are recognized by the type name (or, for a
/// positional argument, the name) FILE or DIR; a fixed set is a CLI::IsMember. The script defines the function
/// _<name> and registers it by `complete`.
std::string bash_completion_script(const CLI::App& app);

} // namespace tandem::command
