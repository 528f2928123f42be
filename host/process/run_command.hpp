// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/child_process.hpp"

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace tandem::process {

struct CommandOptions {
    std::chrono::milliseconds timeout = std::chrono::minutes(1);
    std::string input{};         ///< its standard input; empty: /dev/null
    std::string folder{};        ///< its working directory; empty: the one of this process
    bool capture_report = false; ///< the command has a report_descriptor and may write to it
    bool discard_output = false; ///< standard output goes to /dev/null
    bool merge_errors = false;   ///< standard error goes to CommandResult::output, too, in the order written
    bool stop_on_signal = false; ///< SIGINT, SIGTERM and SIGHUP end the command, not this process
    std::size_t max_output = std::size_t{256} << 20; ///< bytes; limits the output, and also the report
    std::size_t max_errors = std::size_t{16} << 20;  ///< bytes; of a longer standard error the end is kept
};

struct CommandResult {
    bool timed_out = false; ///< killed with its process group: after the timeout, or above max_output
    int stop_signal = 0;    ///< the signal to this process for which the command's process group was killed
    ExitStatus status{};    ///< valid if the command ended by itself
    std::string output{}, errors{};
    std::string report{}; ///< what it wrote to its report_descriptor

    bool succeeded() const { return !timed_out && stop_signal == 0 && status.success(); }
    int exit_code() const { return timed_out || stop_signal != 0 || status.signalled ? -1 : status.code; }
    std::string failure() const; ///< the first non-blank line of `errors`, or else how the command ended
};

/// Runs command[0], which is looked up on PATH if it has no slash, and waits for its end. On return no process of its
/// group is left. Does not wait for a process that has left the group and keeps the pipes open. Throws
/// std::system_error, which names the program, if it cannot be started. [any-thread]
CommandResult run_command(const std::vector<std::string>& command, const CommandOptions& options = {});

} // namespace tandem::process
