// SPDX-License-Identifier: Apache-2.0
#include "host/process/ready_line.hpp"

#include <cstdio>
#include <cstdlib>
#include <iostream>

namespace tandem::process {

void write_ready_line(const std::string& line) {
    std::cout.flush();
    std::fputs(((std::getenv("TANDEM_SUPERVISED") == nullptr ? "" : "\n") + line + "\n").c_str(), stdout);
    std::fflush(stdout);
}

} // namespace tandem::process
