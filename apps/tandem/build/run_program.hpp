// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace tandem::command {

struct ProgramEnd {
    bool timed_out = false; ///< it has been killed, with all that it had started
    int exit_code = 0;      ///< 128 + signal when it was killed by somebody else
    std::string output;     ///< standard output and error together
};

/// Runs a program of the PATH to its end, at most for the time given. Throws std::runtime_error when there is
/// none, or when a signal (SIGINT, SIGTERM, SIGHUP) ends the wait: the program is killed and the caller can
/// clean up.
ProgramEnd run_program(const std::vector<std::string>& command, std::chrono::milliseconds bound);

/// The first line of a build's output that tells of an error, without the colours; or its last line.
std::string first_error(const std::string& output);

} // namespace tandem::command
