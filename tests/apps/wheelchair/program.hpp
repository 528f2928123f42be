// SPDX-License-Identifier: Apache-2.0
// The program `wheelchair` as a user runs it, for the integration tests.
#pragma once

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "host/process/run_command.hpp"

inline tandem::process::CommandResult wheelchair_program(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{WHEELCHAIR_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return tandem::process::run_command(command);
}

inline std::string file_content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}
