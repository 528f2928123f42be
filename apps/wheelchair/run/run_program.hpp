// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tandem::wheelchair {

struct ProgramResult {
    int exit_code = -1;
    std::string errors; // what it wrote to stderr
    std::string output; // and to stdout
    std::string first_line() const { return errors.substr(0, errors.find('\n')); }
};

/// Runs a program found on PATH in `folder`, feeds it `input`, and waits for its end, at most a minute.
ProgramResult run_program(const std::vector<std::string>& command, const std::string& input,
                          const std::string& folder);

} // namespace tandem::wheelchair
