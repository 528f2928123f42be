// SPDX-License-Identifier: Apache-2.0
// The commands that watch the messages of a running link. Each prints its result and returns the exit code; errors are
// exceptions of one line.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace tandem::command {

struct EchoOptions {
    std::string link;
    std::vector<std::string> ports; ///< none: all
    std::uint64_t count = 0;        ///< messages after which to end; 0: never
    double timeout_s = 0;           ///< without a message for so long it ends, with exit code 1; 0: never
    bool json = false;
};
int echo(const EchoOptions& options);

struct HzOptions {
    std::string link;
    std::vector<std::string> ports; ///< none: all
    double period_s = 1;            ///< one table for each
    std::uint64_t count = 0;        ///< tables after which to end; 0: never
    bool json = false;
};
int hz(const HzOptions& options);

} // namespace tandem::command
