// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstdint>

namespace tandem::shm {

/// The length of a tick of the processor's counter, computed from an interval that both clocks measured. A longer interval gives
/// a more exact length. Used for the length of past waits: reading the counter takes one instruction, reading the
/// clock a call and cold cache lines.
class TickLength {
  public:
    TickLength(std::uint64_t ns, std::uint64_t ticks)
        : fraction_(std::min((std::min(ns, max_ns) << fraction_bits) / std::max<std::uint64_t>(ticks, 1),
                             max_fraction)) {}

    /// Returns the nanoseconds of `ticks`, to 2^4 ticks; for ticks of up to 64 ns and times of up to a day.
    std::uint64_t ns(std::uint64_t ticks) const {
        return (ticks >> coarse_bits) * fraction_ >> (fraction_bits - coarse_bits);
    }

  private:
    static constexpr unsigned fraction_bits = 20, coarse_bits = 4;
    static constexpr std::uint64_t max_ns = std::uint64_t{1} << 40;
    static constexpr std::uint64_t max_fraction = std::uint64_t{1} << (fraction_bits + 6);

    std::uint64_t fraction_; // of a nanosecond, in 2^-20
};

} // namespace tandem::shm
