// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>

namespace tandem::mcap {

/// Earliest and latest log time of messages; 0 without messages.
class TimeRange {
  public:
    void add(std::uint64_t time) {
        start_ = std::min(start_, time);
        end_ = std::max(end_, time);
    }
    std::uint64_t start() const { return start_ <= end_ ? start_ : 0; }
    std::uint64_t end() const { return end_; }

  private:
    std::uint64_t start_ = std::numeric_limits<std::uint64_t>::max(), end_ = 0;
};

} // namespace tandem::mcap
