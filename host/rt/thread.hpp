// SPDX-License-Identifier: Apache-2.0
// What a thread or a process asks of the kernel for real time. Nothing here is needed for correctness: what
// is refused comes back as a one-line notice for the log, and the program runs on without it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tandem::rt {

struct ThreadOptions {
    std::string name;         ///< at most 15 characters are shown
    int fifo_priority = 0;    ///< 1..99: SCHED_FIFO; 0: leave the scheduling class alone
    int cpu = -1;             ///< pin to this processor; -1: leave the affinity alone
    bool round_robin = false; ///< SCHED_RR in place of SCHED_FIFO
};

/// Applies the options to the calling thread, and a timer slack of 1 ns always. Returns a notice for each
/// refusal.
std::vector<std::string> configure_this_thread(const ThreadOptions& options);

/// Pins the calling thread, and those that it will start, to one processor or some. Returns a notice, which
/// begins with `who`, when refused.
std::optional<std::string> pin_this_thread(const std::string& who, int cpu);
std::optional<std::string> pin_this_thread(const std::string& who, const std::vector<int>& cpus);

/// Locks present and future memory of the process (mlockall). Returns a notice when not permitted.
std::optional<std::string> lock_memory();

/// Keeps the processors out of deep idle states until the process ends. Returns a notice when not permitted.
std::optional<std::string> hold_low_latency_idle();

/// Sends SIGTERM to this process when its parent dies. Returns a notice when refused or already orphaned.
std::optional<std::string> terminate_with_parent();

} // namespace tandem::rt
