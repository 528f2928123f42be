// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <ctime>

#include "plugins/wheelchair/core/plant/parameters.hpp"

namespace tandem::wheelchair {

/// CLOCK_MONOTONIC in seconds: one clock for all processes of a machine, so stamps of different hosts
/// compare.
inline double monotonic_seconds() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What a component's parameter `clock` selects.
enum class ClockKind {
    monotonic, ///< CLOCK_MONOTONIC
    simulated, ///< the number of the component's tick times 10 ms
    arrival    ///< CLOCK_MONOTONIC, for senders of other machines, whose stamps are of a clock of their own
};

/// The clock of a component's stamps.
class TickClock {
  public:
    explicit TickClock(ClockKind kind) : kind_(kind) {}
    bool simulated() const { return kind_ == ClockKind::simulated; }
    double at(int tick) const { return simulated() ? tick * tick_seconds : monotonic_seconds(); }
    /// When a message that arrives in this tick counts as sent: never later than now, because a stamp from the future
    /// would keep it fresh for ever.
    double sent_at(double stamp, int tick) const {
        const double now = at(tick);
        return kind_ == ClockKind::arrival ? now : std::min(stamp, now);
    }

  private:
    ClockKind kind_;
};

} // namespace tandem::wheelchair
