// SPDX-License-Identifier: Apache-2.0
// The program `tandem` as a user runs it: a child process whose output and exit code the test gets.
#pragma once
#include "tests/shm/fixture.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace tandem::test {

struct Result {
    int exit_code;
    std::string output, errors;
    nlohmann::json json() const;
    bool output_contains(const std::string& text) const { return output.find(text) != std::string::npos; }
};

Result tandem_program(std::vector<std::string> arguments);
Result shm_program(std::vector<std::string> arguments);

/// The segment of a link in the output of `shm list --json`; null if it is not listed.
nlohmann::json listed(const std::string& link);

} // namespace tandem::test
