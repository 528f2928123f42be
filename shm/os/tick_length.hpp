// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstdint>

namespace tandem::shm {

/// How long a tick of the time-stamp counter is, from a time that was measured by both clocks: as exact as that one was
/// long. For the length of a wait that is over: the counter takes one instruction, a clock a call and cold lines.
class TickLength {
  public:
    TickLength(std::uint64_t ns, std::uint64_t ticks)
        : fraction_(std::min((std::min(ns, max_ns) << fraction_bits) / std::max<std::uint64_t>(ticks, 1),
                             max_fraction)) {}

    /// In nanoseconds, to 2^10 ticks; for ticks of up to 64 ns, and times of up to a day.
    std::uint64_t ns(std::uint64_t ticks) const {
        return (ticks >> coarse_bits) * fraction_ >> (fraction_bits - coarse_bits);
    }

  private:
    static constexpr unsigned fraction_bits = 20, coarse_bits = 10;
    static constexpr std::uint64_t max_ns = std::uint64_t{1} << 40;
    static constexpr std::uint64_t max_fraction = std::uint64_t{1} << (fraction_bits + 6);

    std::uint64_t fraction_; // of a nanosecond, in 2^-20
};

} // namespace tandem::shm
