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
    std::string folder{};        ///< its working folder; empty: that of this process
    bool capture_report = false; ///< the command has a report_descriptor and may write to it
    bool discard_output = false; ///< standard output goes to /dev/null
    bool merge_errors = false;   ///< standard error goes to CommandResult::output, too, in the order written
    bool stop_on_signal = false; ///< SIGINT, SIGTERM and SIGHUP end the command, not this process
    std::size_t max_output = std::size_t{256} << 20; ///< bytes of output, or of report, that it may write
    std::size_t max_errors = std::size_t{16} << 20;  ///< of a longer standard error the end is kept
};

struct CommandResult {
    bool timed_out = false; ///< killed with its process group: after the timeout, or above max_output
    int stop_signal = 0;    ///< killed with its process group because this process got that signal
    ExitStatus status{};    ///< if it ended by itself
    std::string output{}, errors{};
    std::string report{}; ///< what it wrote to its report_descriptor

    bool succeeded() const { return !timed_out && stop_signal == 0 && status.success(); }
    int exit_code() const { return timed_out || stop_signal != 0 || status.signalled ? -1 : status.code; }
    std::string failure() const; ///< one line: the first of `errors` that is not blank, else how it ended
};

/// Runs command[0] (looked up on PATH if it has no slash) to its end. When this returns, no process of its
/// group is left; a process that left the group and keeps the pipes open is not waited for.
/// Throws std::system_error that names the program when it cannot be started. [any-thread]
CommandResult run_command(const std::vector<std::string>& command, const CommandOptions& options = {});

} // namespace tandem::process
