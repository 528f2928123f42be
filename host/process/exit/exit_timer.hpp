// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <ctime>
#include <string>

namespace tandem::process {

/// Ends the process with `code` if the object still exists when `limit` has passed, and writes `line` to standard error
/// before. Flushes nothing. Needs no thread: a timer of the kernel sends SIGRTMAX, whose handler it replaces. For code that
/// must return while the host ends and no thread is free. [any-thread]
class ExitTimer {
  public:
    ExitTimer(std::chrono::nanoseconds limit, const std::string& line, int code);
    ~ExitTimer();
    ExitTimer(const ExitTimer&) = delete;
    ExitTimer& operator=(const ExitTimer&) = delete;

  private:
    std::atomic<bool>* is_armed_; ///< is never deleted
    timer_t timer_{};
    bool has_timer_ = false;
};

} // namespace tandem::process
