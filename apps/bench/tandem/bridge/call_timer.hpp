// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/tandem/bridge/ping.hpp"

namespace tandem::bench {

/// [tick-thread] What the callers of both models share: times `double add(double, double)` of the other side.
class CallTimer {
  public:
    CallTimer(std::string file, std::size_t samples, double seconds)
        : samples_(std::move(file), samples, seconds, 1000) {}

    /// The caller's onExecute(). add(a, b) returns a sum, or nothing while nobody answers yet.
    template <class Add>
    void call_for_a_slice(Add&& add) {
        const std::uint64_t end = ticks() + to_ticks(slice_ns);
        while (!samples_.done()) {
            a_ += 1;
            const std::uint64_t before = ticks();
            if (before >= end) return;
            const auto sum = add(a_, b_);
            const std::uint64_t now = ticks();
            if (!sum) return; // the next tick calls again
            if (*sum != a_ + b_) throw std::runtime_error("the result of a call is wrong");
            samples_.add(to_ns(now - before), now);
        }
    }

  private:
    Samples samples_;
    double a_ = 0, b_ = 0.5;
};

} // namespace tandem::bench
