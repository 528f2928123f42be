// SPDX-License-Identifier: Apache-2.0
// The commands that watch the messages of a running link. Each prints its result and returns the exit code.
// Errors are exceptions with a one-line message.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace tandem::command {

struct EchoOptions {
    std::string link;
    std::vector<std::string> ports; ///< none: all
    std::uint64_t count = 0;        ///< end after this number of messages; 0: never
    double timeout_s = 0;           ///< end with exit code 1 after this time without a message; 0: never
    bool json = false;
};
int echo(const EchoOptions& options);

struct HzOptions {
    std::string link;
    std::vector<std::string> ports; ///< none: all
    double period_s = 1;            ///< period of the tables
    std::uint64_t count = 0;        ///< end after this number of tables; 0: never
    bool json = false;
};
int hz(const HzOptions& options);

} // namespace tandem::command
