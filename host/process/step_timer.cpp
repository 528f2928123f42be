// SPDX-License-Identifier: Apache-2.0
#include "host/process/step_timer.hpp"

namespace tandem::process {

void StepTimer::begin(std::string step) {
    const std::lock_guard lock(mutex_);
    step_ = std::move(step);
    start_ = Clock::now();
    next_report_ = first_report;
}

std::string StepTimer::step() const {
    const std::lock_guard lock(mutex_);
    return step_;
}

std::string StepTimer::slow_step() {
    const std::lock_guard lock(mutex_);
    if (Clock::now() - start_ < next_report_) return "";
    std::string text = step_ + " has taken " + std::to_string(next_report_.count()) + " s so far";
    next_report_ *= 2;
    return text;
}

} // namespace tandem::process
