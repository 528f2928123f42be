// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <bit>
#include <cstdint>

namespace tandem::process {

/// Limits how often a condition that may repeat in every cycle is logged: only its 1st, 2nd, 4th, 8th ... occurrence.
/// Use one object for each condition. [any-thread]
class LogThrottle {
  public:
    /// Counts one occurrence. Returns true if this occurrence should be logged.
    bool should_log() { return std::has_single_bit(++count_); }
    /// Returns the number of occurrences so far, for the message.
    std::uint64_t count() const { return count_; }

  private:
    std::atomic<std::uint64_t> count_{0};
};

} // namespace tandem::process
