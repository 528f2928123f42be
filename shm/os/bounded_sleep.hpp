// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/atomics.hpp"

namespace tandem::shm {

/// Sleeps while `word` holds `expected`, until woken or now_ns() reaches `deadline`. May return early. A long
/// sleep sets no kernel timer (futex_timeout_thread.hpp).
void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline);

/// Several sleeps that together take no longer than `bound`, give or take a tick of the coarse clock. The
/// exact clock is never read, because reading it would cost each sleep more than the precision is worth: the
/// first sleep ends by itself, and the later ones are measured by the coarse clock.
class BoundedSleep {
  public:
    explicit BoundedSleep(std::chrono::nanoseconds bound);

    /// Sleeps while `word` holds `expected`; may return early. False: the bound has passed.
    bool sleep_while(std::atomic<std::uint32_t>& word, std::uint32_t expected);

  private:
    std::uint64_t bound_ns_, started_ns_;
    bool first_ = true;
};

} // namespace tandem::shm
