// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "plugins/wheelchair/core/plant/parameters.hpp"

namespace tandem::wheelchair {

/// Returns CLOCK_MONOTONIC in s. All processes of a machine share this clock, so stamps of different hosts are
/// comparable.
inline double monotonic_seconds() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Values of a component's parameter `clock`.
enum class ClockKind {
    monotonic, ///< CLOCK_MONOTONIC
    simulated, ///< number of the component's tick times 10 ms
    arrival    ///< CLOCK_MONOTONIC, for senders on machines with another clock, see SentTime
};

/// The clock for a component's stamps.
class TickClock {
  public:
    explicit TickClock(ClockKind kind) : kind_(kind) {}
    bool simulated() const { return kind_ == ClockKind::simulated; }
    double at(int tick) const { return simulated() ? tick * tick_seconds : monotonic_seconds(); }

  private:
    ClockKind kind_;
};

/// Determines the time at which one sender's messages were sent, by the receiver's clock.
class SentTime {
  public:
    explicit SentTime(ClockKind kind) : kind_(kind) {}

    /// Returns the time of a message that arrives at `now` [s]. The time is never later than `now`, because a future
    /// stamp would keep the message fresh forever. For a sender with another clock, it is `now` minus the message's
    /// delay beyond that of the fastest recent message, because a network can delay messages.
    double of(double stamp, double now) {
        if (!std::isfinite(stamp)) return -unknown; // no comparison would find it late
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
    // The fastest message of the last one or two windows. Meanwhile the clocks drift by less than 1 ms. After two
    // windows, a sender with a restarted clock is trusted again.
    static constexpr double window_seconds = 5.0;
    static constexpr double unknown = std::numeric_limits<double>::infinity();

    ClockKind kind_;
    double window_begin_ = -unknown;
    double quickest_ = unknown, quickest_before_ = unknown; // arrival minus stamp, s
};

} // namespace tandem::wheelchair
