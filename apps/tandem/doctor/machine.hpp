// SPDX-License-Identifier: Apache-2.0
// What the doctor looks at: files under a root, and what the kernel answers to calls. Tests bring both.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>

namespace tandem::doctor {

constexpr std::uint64_t unlimited = ~std::uint64_t{0};

/// Answers that no file gives. *_error: errno of an attempt, 0 if it went well.
struct ProbedValues {
    std::uint64_t memlock_limit = 0, rtprio_limit = 0, files_limit = 0; ///< soft limits, or unlimited
    std::uint64_t shm_bytes = 0, shm_free = 0;                          ///< of /dev/shm
    int lock_error = 0;                                                 ///< mlockall(), then 64 MiB more
    int fifo_error = 0;                                                 ///< SCHED_FIFO, priority 50
    int inotify_error = 0;                                              ///< one more inotify instance
    int dma_latency_error = 0; ///< may /dev/cpu_dma_latency be written?
    std::uint64_t timer_slack_ns = 0;
    unsigned cores = 0; ///< that this process may use
    uid_t user = 0;
};

struct Machine {
    std::filesystem::path root = "/";
    ProbedValues probed;

    std::filesystem::path path(const std::string& absolute) const { return root / absolute.substr(1); }
    bool exists(const std::string& absolute) const;
    std::optional<std::string> content(const std::string& absolute) const;    ///< of a file, at most 1 MiB
    std::optional<std::string> first_line(const std::string& absolute) const; ///< without blanks at its ends
};

/// This machine. What may only be found out by trying is tried in a child process.
Machine probe_this_machine();

std::string trim(const std::string& text);
std::string
bracketed_word(const std::string& choices); ///< "always [never] deny" -> "never"; "" if there is none

} // namespace tandem::doctor
