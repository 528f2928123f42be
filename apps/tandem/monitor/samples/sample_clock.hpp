// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace tandem::monitor {

/// What the clocks of this machine show at one moment.
struct ClockTimes {
    double wall_ms, monotonic_ms;
    static ClockTimes now();
};

/// Finds the times of a port's messages on the clock of this machine. [one thread]
class SampleClock {
  public:
    explicit SampleClock(const ClockTimes& now = ClockTimes::now())
        : monotonic_offset_ms_(now.wall_ms - now.monotonic_ms) {}
    /// Returns the time of a message in ms since the epoch, later than that of the message before unless the clock was set
    /// back. `stamp`: see wire::pack_time().
    double time_of(std::uint64_t stamp, const ClockTimes& now = ClockTimes::now());

  private:
    double monotonic_offset_ms_; ///< from CLOCK_MONOTONIC to CLOCK_REALTIME
    double offset_ms_ = 0, last_sent_ms_ = 0, last_ = 0;
};

} // namespace tandem::monitor
