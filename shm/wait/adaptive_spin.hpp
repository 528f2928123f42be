// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>

namespace tandem::shm {

/// [any-thread] How long to poll before sleeping, learnt from how long the waits were: polling pays only if
/// what one waits for comes soon. A wait that ended while polling or shortly after restores the full time;
/// one that went on far beyond it halves it, down to about the price of falling asleep.
class AdaptiveSpin {
  public:
    std::uint64_t limit_ns(std::uint64_t longest) const {
        return std::max(std::min(longest, shortest), longest >> halvings_.load(std::memory_order_relaxed));
    }

    void learn(std::uint64_t longest, std::uint64_t waited) {
        const std::uint32_t now = halvings_.load(std::memory_order_relaxed);
        if (waited <= 2 * longest) {
            if (now != 0) halvings_.store(0, std::memory_order_relaxed);
        } else if (waited > 4 * longest && now < most_halvings) {
            halvings_.store(now + 1, std::memory_order_relaxed);
        }
    }

  private:
    static constexpr std::uint64_t shortest = 2'000;
    static constexpr std::uint32_t most_halvings = 16;

    std::atomic<std::uint32_t> halvings_{0};
};

} // namespace tandem::shm
