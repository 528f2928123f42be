// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace tandem::rt {

/// A mutex for what a component's cycle passes through: without contention, lock and unlock are one atomic instruction
/// each and no call, a fifth of the instructions of std::mutex. A thread that has to wait sleeps. Not recursive, no
/// priority inheritance (as std::mutex has none). For std::lock_guard. The algorithm is the second mutex of U. Drepper,
/// "Futexes Are Tricky". [any-thread]
class ShortMutex {
  public:
    void lock() {
        int state = unlocked;
        if (!state_.compare_exchange_strong(state, locked, std::memory_order_acquire,
                                            std::memory_order_relaxed))
            wait_and_lock();
    }
    void unlock() {
        if (state_.exchange(unlocked, std::memory_order_release) == locked_with_waiters) [[unlikely]]
            wake_one();
    }

  private:
    static constexpr int unlocked = 0, locked = 1, locked_with_waiters = 2;

    // Neither is on the way of a message: without them here, its code is denser.
    [[gnu::cold, gnu::noinline]] void wake_one() { state_.notify_one(); }
    [[gnu::cold, gnu::noinline]] void wait_and_lock() {
        // The thread that gets the lock here cannot know whether others still wait: it leaves the state that makes
        // unlock() wake one.
        while (state_.exchange(locked_with_waiters, std::memory_order_acquire) != unlocked)
            state_.wait(locked_with_waiters, std::memory_order_relaxed);
    }

    std::atomic<int> state_{unlocked};
};

} // namespace tandem::rt
