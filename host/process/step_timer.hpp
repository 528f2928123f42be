// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace tandem::process {

/// The current step of a host's set-up of its components, and how long it has taken so far. [any-thread]
class StepTimer {
  public:
    explicit StepTimer(std::string first_step) : step_(std::move(first_step)) {}
    /// `step` is a noun phrase with the component, for example `onInitialize of component Camera0`.
    void begin(std::string step);
    std::string step() const;
    /// Returns `STEP has taken N s so far` once each when the current step has taken 2 s, 4 s, 8 s, ..., so that a slow
    /// device does not fill the log. Otherwise returns an empty string.
    std::string slow_step();

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds first_report{2};
    mutable std::mutex mutex_; // guards the members below
    std::string step_;
    Clock::time_point start_ = Clock::now();
    std::chrono::seconds next_report_ = first_report;
};

} // namespace tandem::process
