// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/processor.hpp"

namespace tandem::shm {

/// [one thread] Returns now_ns() as of at most 66 us ago, by the processor's counter. For users that need no more precision:
/// the fences of an exact reading cost a short call a sixth of its time. `P` is a processor, so that tests can choose the
/// frequency of its counter.
template <class P>
class BasicRecentClock {
  public:
    static constexpr std::uint64_t max_age_ns = 100'000;

    std::uint64_t now_ns() {
        const std::uint64_t ticks = P::counter();
        if (ticks - ticks_ > ticks_within<P>(age_ns)) { // true also if the counter went back, on another core
            ticks_ = ticks;
            ns_ = shm::now_ns();
        }
        return ns_;
    }

  private:
    static constexpr std::uint64_t age_ns = std::uint64_t{1} << 16;
    std::uint64_t ticks_ = 0, ns_ = 0;
};
using RecentClock = BasicRecentClock<Processor>;

} // namespace tandem::shm
