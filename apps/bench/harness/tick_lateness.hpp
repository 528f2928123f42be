// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace tandem::bench {

/// [tick-thread] How late ticks are, counted as cyclictest (rt-tests) counts its own: from the first period that began since the
/// previous tick, so that a tick 3.2 periods late is one sample of 3.2 periods, not four samples.
class TickLateness {
  public:
    /// Periods begin at origin_ns plus multiples of period_ns, on CLOCK_MONOTONIC.
    TickLateness(std::int64_t period_ns, std::int64_t origin_ns)
        : period_ns_(period_ns), origin_ns_(origin_ns) {}

    /// Of the tick that begins at now_ns, in ns. Below 0: the period has had its tick, and this one is none of its own; an executor
    /// may tick at once after a late tick.
    std::int64_t of_tick(std::int64_t now_ns) {
        if (due_ns_ == 0) due_ns_ = now_ns - (now_ns - origin_ns_) % period_ns_;
        const std::int64_t late = now_ns - due_ns_;
        if (late >= 0) due_ns_ += (late / period_ns_ + 1) * period_ns_;
        return late;
    }

  private:
    std::int64_t period_ns_, origin_ns_, due_ns_ = 0;
};

} // namespace tandem::bench
