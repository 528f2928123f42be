// SPDX-License-Identifier: Apache-2.0
// The input of the checks of `tandem doctor`: files under a root folder, and results of system calls.
// Checks read nothing else, so that a test can simulate any machine.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>

namespace tandem::doctor {

constexpr std::uint64_t unlimited = ~std::uint64_t{0};

/// Results of system calls that no file shows. *_error: errno of an attempt, 0 if it succeeded.
struct ProbedValues {
    std::uint64_t memlock_limit = 0, rtprio_limit = 0, files_limit = 0; ///< soft limits, or unlimited
    std::uint64_t shm_bytes = 0, shm_free = 0;                          ///< size and free space of /dev/shm
    int lock_error = 0;                                                 ///< mlockall(), then 64 MiB more
    int fifo_error = 0;                                                 ///< SCHED_FIFO, priority 50
    int inotify_error = 0;                                              ///< one more inotify instance
    int dma_latency_error = 0;        ///< write access to /dev/cpu_dma_latency
    std::uint64_t timer_slack_ns = 0; ///< of this thread, see PR_SET_TIMERSLACK
    unsigned cores = 0;               ///< cores that this process may use
    uid_t user = 0;                   ///< effective user
    std::string runtime_dir{};        ///< XDG_RUNTIME_DIR; empty: not set
    bool clock_synchronized =
        false; ///< as reported to the kernel by the program that sets the clock, see adjtimex(2)
    long clock_max_error_us = 0; ///< the kernel's bound of the clock's error
};

struct Machine {
    std::filesystem::path root = "/";
    ProbedValues probed;

    /// Returns the path of the machine's file `absolute`, for example "/proc/cpuinfo", below the root.
    std::filesystem::path path(const std::string& absolute) const { return root / absolute.substr(1); }
    bool exists(const std::string& absolute) const;
    /// Returns at most the first MiB of a file; nullopt if it cannot be read.
    std::optional<std::string> content(const std::string& absolute) const;
    /// Returns the first line of a file, trimmed; nullopt if the file cannot be read.
    std::optional<std::string> first_line(const std::string& absolute) const;
};

/// Returns the machine that this process runs on and the permissions of its user. Attempts that would
/// change the process (locking memory, SCHED_FIFO) run in a child process.
Machine probe_this_machine();

/// Returns `text` without blanks at both ends.
std::string trim(const std::string& text);

/// Returns the choice that the kernel marks in a list: "never" for "always [never] deny"; "" if none is
/// marked.
std::string bracketed_word(const std::string& choices);

} // namespace tandem::doctor
