// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <bit>
#include <cstdint>

namespace tandem::link {

/// For messages about what may repeat in every tick: says yes at the 1st, 2nd, 4th, 8th ... time.
/// [any-thread]
class Rare {
  public:
    bool now() { return std::has_single_bit(++count_); }
    std::uint64_t count() const { return count_; }

  private:
    std::atomic<std::uint64_t> count_{0};
};

} // namespace tandem::link
