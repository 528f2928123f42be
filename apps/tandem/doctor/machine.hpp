// SPDX-License-Identifier: Apache-2.0
// What the checks of `tandem doctor` look at: files under a root folder, and the answers of system calls. A check
// reads nothing else, so that a test can give it any machine.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>

namespace tandem::doctor {

constexpr std::uint64_t unlimited = ~std::uint64_t{0};

/// What system calls answer and no file shows. *_error: errno of an attempt, 0 if it succeeded.
struct ProbedValues {
    std::uint64_t memlock_limit = 0, rtprio_limit = 0, files_limit = 0; ///< soft limits, or unlimited
    std::uint64_t shm_bytes = 0, shm_free = 0;                          ///< size and free space of /dev/shm
    int lock_error = 0;                                                 ///< mlockall(), then 64 MiB more
    int fifo_error = 0;                                                 ///< SCHED_FIFO, priority 50
    int inotify_error = 0;                                              ///< one more inotify instance
    int dma_latency_error = 0;        ///< write access to /dev/cpu_dma_latency
    std::uint64_t timer_slack_ns = 0; ///< of this thread, see PR_SET_TIMERSLACK
    unsigned cores = 0;               ///< that this process may use
    uid_t user = 0;                   ///< effective user
    bool clock_synchronized =
        false; ///< what the program that sets the clock has told the kernel, see adjtimex(2)
    long clock_max_error_us = 0; ///< the kernel's bound of the clock's error
};

struct Machine {
    std::filesystem::path root = "/";
    ProbedValues probed;

    /// Where a file of the machine is found: `absolute` ("/proc/cpuinfo") below the root.
    std::filesystem::path path(const std::string& absolute) const { return root / absolute.substr(1); }
    bool exists(const std::string& absolute) const;
    /// At most the first MiB of a file; empty if it cannot be read.
    std::optional<std::string> content(const std::string& absolute) const;
    /// The first line of a file without the blanks at its ends; empty if it cannot be read.
    std::optional<std::string> first_line(const std::string& absolute) const;
};

/// The machine and the user that this process runs on and as. Attempts that would change the process (locking
/// memory, SCHED_FIFO) are made in a child process.
Machine probe_this_machine();

/// Without the blanks at both ends.
std::string trim(const std::string& text);

/// The choice that the kernel marks in a list: "always [never] deny" -> "never"; "" if none is marked.
std::string bracketed_word(const std::string& choices);

} // namespace tandem::doctor
