// SPDX-License-Identifier: Apache-2.0
// Requests to the kernel that make a thread or a process suitable for real time. None of them is needed for
// correctness: if the kernel refuses, each function returns one line for the log, and the program continues without it. The
// line is also published, so that observers see that the setting is not in effect (host/process/published/notices.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tandem::rt {

/// Options for configure_this_thread().
struct ThreadOptions {
    std::string name;         ///< the kernel keeps the first 15 characters
    int fifo_priority = 0;    ///< 1..99: SCHED_FIFO; 0: leave the scheduling class alone
    int cpu = -1;             ///< pin to this processor; -1: leave the affinity alone
    bool round_robin = false; ///< SCHED_RR instead of SCHED_FIFO
};

/// Applies the options to the calling thread. Always sets a timer slack of 1 ns, because the default of 50 us would
/// delay each wake-up by up to that time. Returns a notice for each refusal. [any-thread]
std::vector<std::string> configure_this_thread(const ThreadOptions& options);

/// Pins the calling thread, and the threads that it starts later, to one or several processors. The notice begins with
/// `who`. [any-thread]
std::optional<std::string> pin_this_thread(const std::string& who, int cpu);
std::optional<std::string> pin_this_thread(const std::string& who, const std::vector<int>& cpus);

/// Locks the current and future memory of the process (mlockall), so that no tick waits for a page. [any-thread]
std::optional<std::string> lock_memory();

/// Keeps all processors out of deep idle states until the process ends: waking up from one takes tens of us.
/// [any-thread]
std::optional<std::string> hold_low_latency_idle();

/// Makes the kernel send SIGTERM to this process when its parent dies. Also returns a notice if the parent is already
/// dead. [main-thread]
std::optional<std::string> terminate_with_parent();

} // namespace tandem::rt
