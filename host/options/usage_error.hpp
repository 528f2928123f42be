// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace CLI {
class App;
class Error;
} // namespace CLI

namespace tandem::options {

/// What CLI::App::exit() prints of a command line that cannot be parsed, in one line: the command, what is wrong with which
/// argument, and where its options are described. For CLI::App::failure_message().
std::string usage_error(const CLI::App* app, const CLI::Error& error);

} // namespace tandem::options
