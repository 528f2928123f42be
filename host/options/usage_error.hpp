// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>

namespace CLI {
class App;
class Error;
} // namespace CLI

namespace tandem::options {

/// Returns the line that CLI::App::exit() prints about an invalid command line: the command, the wrong argument and
/// its error, and where the options are described. For CLI::App::failure_message().
std::string usage_error(const CLI::App* app, const CLI::Error& error);

/// Parses the command line. If the program must end, because help or a version was requested or the command line is invalid,
/// prints this and returns the exit code.
std::optional<int> parse(CLI::App& app, int argc, char** argv);

} // namespace tandem::options
