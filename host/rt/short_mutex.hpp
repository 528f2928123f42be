// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

namespace tandem::rt {

/// A mutex for what a component's cycle passes through. Not recursive, no priority inheritance (as std::mutex has none). A
/// thread that has to wait sleeps. For ShortLock, std::lock_guard. [any-thread]
///
/// A thread that takes it again and again without another one in between becomes its owner, and needs no instruction that
/// locks a cache line from then on: the owner writes `inside_`, then looks at `asked_`. Another thread writes `asked_`, makes
/// all threads of the process pass a memory barrier (membarrier(2)), and waits until `inside_` is 0. So either the owner
/// sees `asked_`, and takes the usual way, or the other one sees `inside_`, and waits. A mutex that others take often, 64
/// times in a second, has no owner any more. The usual way is the second mutex of U. Drepper, "Futexes Are Tricky".
class ShortMutex {
  public:
    [[gnu::always_inline]] void lock() {
        if (!lock_if_owner()) [[unlikely]]
            lock_without_owner();
    }
    /// Without waiting, and only for the owner: a visit of another thread would cost the owner its place. For what only
    /// prepares a cycle. Returns whether this thread has the mutex now.
    [[gnu::always_inline]] bool lock_if_owner() {
        const std::uintptr_t self = this_thread();
        if (owner_.load(std::memory_order_relaxed) != self) [[unlikely]]
            return false;
        inside_.store(self, std::memory_order_relaxed);
        // The compiler must not exchange the two; the processor is made to keep the order by who asks.
        std::atomic_signal_fence(std::memory_order_seq_cst);
        if (!asked_.load(std::memory_order_acquire)) [[likely]]
            return true;
        inside_.store(0, std::memory_order_release);
        return false;
    }
    /// lock(), or lock_if_owner() for a pass that only prepares a cycle. Returns whether this thread has the mutex now.
    [[gnu::always_inline]] bool lock_to(bool prepare) {
        if (lock_if_owner()) [[likely]]
            return true;
        if (prepare) return false;
        lock_without_owner();
        return true;
    }
    /// Without waiting, for any thread; may fail while the owner only looks whether it may enter. For std::unique_lock.
    bool try_lock() { return lock_if_owner() || try_lock_without_owner(); }
    [[gnu::always_inline]] void unlock() {
        // Another thread, which may write it at this moment, writes no name but its own.
        if (inside_.load(std::memory_order_relaxed) != this_thread()) [[unlikely]]
            return unlock_usual_way();
        inside_.store(0, std::memory_order_release);
    }

  private:
    static constexpr int unlocked = 0, locked = 1, locked_with_waiters = 2;
    /// Values of owner_ that are no thread: none has become the owner yet; none ever will.
    static constexpr std::uintptr_t nobody_yet = 0, nobody_again = 1;

    static std::uintptr_t this_thread() {
        return reinterpret_cast<std::uintptr_t>(__builtin_thread_pointer());
    }
    // Out of line, so that the code of a message is dense.
    void lock_without_owner() noexcept;
    bool try_lock_without_owner() noexcept;
    void unlock_usual_way() noexcept;
    void lock_usual_way() {
        int state = unlocked;
        if (!state_.compare_exchange_strong(state, locked, std::memory_order_acquire,
                                            std::memory_order_relaxed))
            wait_and_lock();
    }
    [[gnu::cold]] void wait_and_lock();
    [[gnu::cold]] void choose_owner(std::uintptr_t self);
    [[gnu::cold]] void ask_owner();
    bool owner_is_inside() const { return inside_.load(std::memory_order_acquire) != 0; }
    void tell_owner_to_stay_out();
    void count_change();

    /// The owner, while it has the mutex, else 0; written by the owner only, or by one that has lost it and looks at asked_.
    /// The first member, since who leaves needs no other.
    std::atomic<std::uintptr_t> inside_{0};
    std::atomic<std::uintptr_t> owner_{
        nobody_yet}; ///< changed with the usual way's lock held, as all below it
    std::atomic<int> state_{unlocked};
    std::atomic<bool> asked_{false}; ///< another thread has the mutex, or waits for the owner to leave
    std::uint8_t in_a_row_ = 0;      ///< how often one thread has taken the mutex since another thread did
    std::uint8_t changes_ = 0;       ///< how often another thread has come, to an owner since then
    std::uint64_t last_or_since_ms_ = 0; ///< until there is an owner, who has taken the mutex last
};

/// std::lock_guard for a ShortMutex; that one is often no part of the function that uses it.
class ShortLock {
  public:
    [[gnu::always_inline]] explicit ShortLock(ShortMutex& mutex) : mutex_(mutex) { mutex_.lock(); }
    [[gnu::always_inline]] ShortLock(ShortMutex& mutex, std::adopt_lock_t) : mutex_(mutex) {}
    ShortLock(const ShortLock&) = delete;
    ShortLock& operator=(const ShortLock&) = delete;
    [[gnu::always_inline]] ~ShortLock() { mutex_.unlock(); }

  private:
    ShortMutex& mutex_;
};

} // namespace tandem::rt
