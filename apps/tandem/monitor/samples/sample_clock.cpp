// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/samples/sample_clock.hpp"

#include "apps/tandem/record/cdr_message.hpp"
#include "proxy/wire/time.hpp"
#include "shm/os/clock.hpp"

#include <algorithm>
#include <cmath>

namespace tandem::monitor {
namespace {

/// A time further from the time of reading comes from another clock.
constexpr double believable_ms = 2000;
/// A larger change between the two clocks of this machine means that the time of day was set.
constexpr double set_ms = 50;

} // namespace

ClockTimes ClockTimes::now() {
    return {static_cast<double>(command::wall_clock_ns()) / 1e6, static_cast<double>(shm::now_ns()) / 1e6};
}

/// The sender's clock may be this machine's wall clock, its monotonic clock, or another clock of the same rate; the first
/// message gives the offset of the latter. Without a useful stamp, the time of reading counts.
double SampleClock::time_of(std::uint64_t stamp, const ClockTimes& now) {
    if (const double offset_ms = now.wall_ms - now.monotonic_ms;
        std::abs(offset_ms - monotonic_offset_ms_) > set_ms)
        *this = SampleClock(now);
    const double sent_ms = 1e3 * wire::stamp_seconds(stamp) + wire::stamp_nanoseconds(stamp) / 1e6;
    const auto is_near = [&](double offset_ms) {
        return std::abs(sent_ms + offset_ms - now.wall_ms) < believable_ms;
    };
    double time = now.wall_ms;
    if (sent_ms > last_sent_ms_) {
        for (const double offset_ms : {0.0, monotonic_offset_ms_, offset_ms_})
            if (is_near(offset_ms)) {
                time = sent_ms + offset_ms;
                break;
            }
        if (time == now.wall_ms) offset_ms_ = now.wall_ms - sent_ms;
    }
    last_sent_ms_ = sent_ms;
    return last_ = std::max(time, last_ + 0.001);
}

} // namespace tandem::monitor
