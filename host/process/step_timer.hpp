// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace tandem::process {

/// What a host is busy with while it sets its components up, and how long already. [any-thread]
class StepTimer {
  public:
    explicit StepTimer(std::string first_step) : step_(std::move(first_step)) {}
    /// `step` is a noun with its component, as in `onInitialize of component Camera0`.
    void begin(std::string step);
    std::string step() const;
    /// `STEP has taken N s so far` when the present step has taken 2 s, 4 s, 8 s, ..., each once, so that a slow
    /// device does not fill the log; empty otherwise.
    std::string slow_step();

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds first_report{2};
    mutable std::mutex mutex_; // for all below
    std::string step_;
    Clock::time_point start_ = Clock::now();
    std::chrono::seconds next_report_ = first_report;
};

} // namespace tandem::process
