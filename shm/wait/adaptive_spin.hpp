// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>

namespace tandem::shm {

/// [any-thread] Learns from past waits how long to poll before sleeping, because polling pays only if the awaited event comes
/// soon. A wait that ended during polling or shortly afterwards restores the full polling time. A much longer wait halves it,
/// down to about the cost of falling asleep.
class AdaptiveSpin {
  public:
    /// Returns how long to poll now, at most `max_ns`.
    std::uint64_t limit_ns(std::uint64_t max_ns) const {
        return std::max(std::min(max_ns, min_ns), max_ns >> halvings_.load(std::memory_order_relaxed));
    }

    /// Call it after each wait, with the duration of the wait, or with 0 if the wait ended during polling.
    void learn(std::uint64_t max_ns, std::uint64_t waited_ns) {
        const std::uint32_t halvings = halvings_.load(std::memory_order_relaxed);
        if (waited_ns <= 2 * max_ns) {
            if (halvings != 0) halvings_.store(0, std::memory_order_relaxed);
        } else if (waited_ns > 4 * max_ns && halvings < max_halvings) {
            halvings_.store(halvings + 1, std::memory_order_relaxed);
        }
    }

  private:
    static constexpr std::uint64_t min_ns = 2'000;
    static constexpr std::uint32_t max_halvings = 16;

    std::atomic<std::uint32_t> halvings_{0};
};

} // namespace tandem::shm
