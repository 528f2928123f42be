// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <ctime>

namespace tandem::wire {

/// Packs RTM's `Time tm` into the 64-bit stamp of a record's header: seconds in the upper 32 bits, nanoseconds in the
/// lower. Nothing is normalized, so that the time arrives bit for bit.
constexpr std::uint64_t pack_time(std::uint32_t sec, std::uint32_t nsec) {
    return std::uint64_t{sec} << 32 | nsec;
}
constexpr std::uint32_t stamp_seconds(std::uint64_t stamp) { return static_cast<std::uint32_t>(stamp >> 32); }
constexpr std::uint32_t stamp_nanoseconds(std::uint64_t stamp) { return static_cast<std::uint32_t>(stamp); }

/// Returns the stamp of a message without a sender's time: the current time of CLOCK_REALTIME, which RTM uses, too.
inline std::uint64_t wall_clock_stamp() {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    return pack_time(static_cast<std::uint32_t>(now.tv_sec), static_cast<std::uint32_t>(now.tv_nsec));
}

} // namespace tandem::wire
