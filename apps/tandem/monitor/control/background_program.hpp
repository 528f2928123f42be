// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/process/child_process.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tandem::monitor {

/// A program that a page has started, until it ends by itself or is stopped. It reads no input. [one thread]
class BackgroundProgram {
  public:
    /// `output`: the descriptor for its output and errors; -1: those of this process. Throws std::system_error.
    explicit BackgroundProgram(const std::vector<std::string>& command, int output = -1);
    /// Ends it cleanly, and kills it `max_end` after the first request. Asks only once: `tandem run` takes a second request
    /// as one to kill its hosts.
    ~BackgroundProgram();
    BackgroundProgram(const BackgroundProgram&) = delete;
    BackgroundProgram& operator=(const BackgroundProgram&) = delete;

    /// Asks it to end, and returns at once. look() kills it if it has not ended after `max_end`.
    void stop();
    /// Returns how it ended, or nothing while it runs.
    const std::optional<process::ExitStatus>& look();
    std::uint64_t since_ms() const { return since_ms_; } ///< time of its start, since the epoch

  private:
    /// `tandem run` gives its hosts 20 s.
    static constexpr std::chrono::seconds max_end{25};
    process::ChildProcess child_;
    std::uint64_t since_ms_;
    std::optional<std::chrono::steady_clock::time_point> stopped_;
};

} // namespace tandem::monitor
