// SPDX-License-Identifier: Apache-2.0
#pragma once
// The ticks of a periodic component, recorded by the component.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tandem::bench {

/// [tick-thread] The lateness of ticks, counted as cyclictest (rt-tests) does: from the first period that began
/// since the previous tick. A tick that is 3.2 periods late is one sample of 3.2 periods, not four samples.
class TickLateness {
  public:
    /// Periods begin at origin_ns plus multiples of period_ns, on CLOCK_MONOTONIC.
    TickLateness(std::int64_t period_ns, std::int64_t origin_ns)
        : period_ns_(period_ns), origin_ns_(origin_ns) {}

    /// Returns the lateness of the tick that begins at now_ns, in ns. Returns less than 0 for a further tick in a period that
    /// already had its tick: an executor may tick at once after a late tick.
    std::int64_t of_tick(std::int64_t now_ns) {
        if (due_ns_ == 0) due_ns_ = now_ns - (now_ns - origin_ns_) % period_ns_;
        const std::int64_t late = now_ns - due_ns_;
        if (late >= 0) due_ns_ += (late / period_ns_ + 1) * period_ns_;
        return late;
    }

  private:
    std::int64_t period_ns_, origin_ns_, due_ns_ = 0;
};

struct TickCounts {
    std::uint64_t overruns = 0; ///< ticks a period late or more
    std::uint64_t skipped = 0;  ///< periods whose tick came in a later one or not at all

    /// One sample.
    void add(std::int64_t late_ns, std::int64_t period_ns) {
        if (late_ns < period_ns) return;
        ++overruns;
        skipped += static_cast<std::uint64_t>(late_ns / period_ns);
    }
    void add(const TickCounts& other) {
        overruns += other.overruns;
        skipped += other.skipped;
    }
};

/// [tick-thread; read when it has stopped]
class TickRecord {
  public:
    /// [before the first tick] Reserves room for the lateness of `samples` ticks; later ticks are only counted.
    /// Periods begin at origin_ns plus multiples of period_ns, on CLOCK_MONOTONIC.
    void prepare(std::int64_t period_ns, std::size_t samples, std::int64_t origin_ns) {
        period_ns_ = period_ns;
        origin_ns_ = origin_ns;
        lateness_ = TickLateness(period_ns, origin_ns);
        lateness_ns_.reserve(samples);
    }

    /// [tick-thread] Call it at the beginning of a tick. Allocates nothing.
    void record_tick(std::int64_t now_ns) {
        if (ticks_++ == 0) first_ns_ = now_ns;
        last_ns_ = now_ns;
        const std::int64_t late = lateness_.of_tick(now_ns);
        if (late < 0) return;
        counts_.add(late, period_ns_);
        if (lateness_ns_.size() < lateness_ns_.capacity()) lateness_ns_.push_back(late);
    }

    std::uint64_t ticks() const { return ticks_; }
    const TickCounts& counts() const { return counts_; }
    const std::vector<std::int64_t>& lateness_ns() const { return lateness_ns_; }
    /// Returns the difference between the mean and the nominal period, in ns. The clock gives the number of
    /// periods, so skipped periods do not count as drift.
    double mean_drift_ns() const {
        const std::int64_t periods =
            (last_ns_ - origin_ns_) / period_ns_ - (first_ns_ - origin_ns_) / period_ns_;
        if (periods == 0) return 0;
        return static_cast<double>(last_ns_ - first_ns_) / static_cast<double>(periods) -
               static_cast<double>(period_ns_);
    }

  private:
    std::int64_t period_ns_ = 1, origin_ns_ = 0, first_ns_ = 0, last_ns_ = 0;
    TickLateness lateness_{1, 0};
    std::uint64_t ticks_ = 0;
    TickCounts counts_;
    std::vector<std::int64_t> lateness_ns_;
};

} // namespace tandem::bench
