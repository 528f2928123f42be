// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

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
    arrival ///< CLOCK_MONOTONIC, for senders of other machines, whose stamps are of a clock of their own, see SentTime
};

/// The clock of a component's stamps.
class TickClock {
  public:
    explicit TickClock(ClockKind kind) : kind_(kind) {}
    bool simulated() const { return kind_ == ClockKind::simulated; }
    double at(int tick) const { return simulated() ? tick * tick_seconds : monotonic_seconds(); }

  private:
    ClockKind kind_;
};

/// When the messages of one sender count as sent, by the receiver's clock.
class SentTime {
  public:
    explicit SentTime(ClockKind kind) : kind_(kind) {}

    /// Of a message that arrives at `now` [s]: never later, because a stamp from the future would keep it fresh for ever. Of a
    /// sender with a clock of its own: earlier by what the message has taken longer than the quickest one lately, since
    /// a network may hold a message back.
    double of(double stamp, double now) {
        if (!std::isfinite(stamp)) return -unknown; // no comparison with it would ever say that it is late
        if (kind_ != ClockKind::arrival) return std::min(stamp, now);
        if (now - window_begin_ > window_seconds) {
            quickest_before_ = quickest_;
            quickest_ = unknown;
            window_begin_ = now;
        }
        quickest_ = std::min(quickest_, now - stamp);
        return stamp + std::min(quickest_, quickest_before_);
    }

  private:
    // The quickest message of the last one to two windows: the clocks drift apart meanwhile by less than 1 ms, and a sender
    // whose clock begins anew is believed again after two.
    static constexpr double window_seconds = 5.0;
    static constexpr double unknown = std::numeric_limits<double>::infinity();

    ClockKind kind_;
    double window_begin_ = -unknown;
    double quickest_ = unknown, quickest_before_ = unknown; // arrival minus stamp, s
};

} // namespace tandem::wheelchair
