// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <bit>
#include <cstdint>

namespace tandem::process {

/// Limits how often a condition that may repeat in every cycle is logged: its 1st, 2nd, 4th, 8th ...
/// occurrence. One object per condition. [any-thread]
class LogThrottle {
  public:
    /// Counts one occurrence. True if this one is to be logged.
    bool should_log() { return std::has_single_bit(++count_); }
    /// Occurrences so far, for the message.
    std::uint64_t count() const { return count_; }

  private:
    std::atomic<std::uint64_t> count_{0};
};

} // namespace tandem::process
