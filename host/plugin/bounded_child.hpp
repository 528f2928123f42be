// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace tandem::plugin {

constexpr int report_descriptor = 3; ///< where a bounded child writes its report

struct ChildEnd {
    bool timed_out = false; ///< it was killed, with all processes of its group
    int status = 0;         ///< of waitpid(), if it ended by itself
    std::string report;     ///< what it wrote to report_descriptor, at most 16 MiB
    std::string errors;     ///< the end of its standard error, at most 4 KiB
};

/// Runs command[0] (a path) with its standard input and output at /dev/null, at most for the time given.
/// [any-thread] Throws std::system_error when it cannot be started.
ChildEnd run_bounded(const std::vector<std::string>& command, std::chrono::milliseconds bound);

} // namespace tandem::plugin
