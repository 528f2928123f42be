// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tandem::command {

struct ProgramEnd {
    int exit_code = 0;  ///< 128 + signal when it was killed
    std::string output; ///< standard output and error together
};

/// Runs a program of the PATH to its end. Throws std::runtime_error when there is none.
ProgramEnd run_program(const std::vector<std::string>& command);

/// The first line of a build's output that tells of an error, without the colours; or its last line.
std::string first_error(const std::string& output);

} // namespace tandem::command
