// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/atomics.hpp"

namespace tandem::shm {

/// Sleeps while `word` holds `expected`, until it is woken or now_ns() reaches `deadline`. May return early. A long sleep
/// sets no kernel timer (futex_timeout_thread.hpp).
void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline);

/// Bounds several sleeps that together take at most `bound`, to within a tick of the coarse clock. Reading the exact clock
/// would cost each sleep more than the precision is worth. Instead, the first sleep ends at its own timeout, and the coarse
/// clock measures the later ones.
class BoundedSleep {
  public:
    explicit BoundedSleep(std::chrono::nanoseconds bound);

    /// Sleeps while `word` holds `expected`; may return early. Returns false if the bound has passed.
    bool sleep_while(std::atomic<std::uint32_t>& word, std::uint32_t expected);

  private:
    std::uint64_t bound_ns_, started_ns_;
    bool first_ = true;
};

} // namespace tandem::shm
