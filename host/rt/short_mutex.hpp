// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/rehearsal.hpp"

#include <atomic>
#include <cstdint>
#include <mutex>

namespace tandem::rt {

/// A mutex for the path of a component's cycle. Not recursive, and without priority inheritance, like std::mutex. A
/// waiting thread sleeps. For ShortLock and std::lock_guard. [any-thread]
///
/// A thread that takes the mutex repeatedly, without another thread in between, becomes its owner. From then on the
/// owner needs no instruction that locks a cache line: it writes `inside_`, then reads `asked_`. Another thread writes
/// `asked_`, issues a process-wide memory barrier (membarrier(2)), and waits until `inside_` is 0. So
/// either the owner sees `asked_` and locks the usual way, or the other thread sees `inside_` and waits. If other
/// threads take the mutex often, 64 times within a second, it no longer has an owner. The usual way is the second mutex
/// of U. Drepper, "Futexes Are Tricky".
///
/// An owner locks and unlocks in 0.8 ns; the usual way takes 82 ns, std::mutex 84 ns, and a mutex with priority
/// inheritance 117 ns (docs/performance.md has the effect on messages).
class ShortMutex {
  public:
    void lock() {
        if (!lock_if_owner()) [[unlikely]]
            lock_without_owner();
    }
    /// Locks without waiting, and only for the owner: if another thread took the mutex, its owner could lose it. For
    /// a rehearsal. Returns whether this thread now holds the mutex.
    bool lock_if_owner() {
        const std::uintptr_t self = this_thread();
        if (owner_.load(std::memory_order_relaxed) != self) [[unlikely]]
            return false;
        inside_.store(self, std::memory_order_relaxed);
        // The compiler must not reorder the two accesses. The asking thread makes the processor keep their order.
        std::atomic_signal_fence(std::memory_order_seq_cst);
        if (!asked_.load(std::memory_order_acquire)) [[likely]]
            return true;
        inside_.store(0, std::memory_order_release);
        return false;
    }
    /// Calls lock(), or, in a rehearsal, lock_if_owner(). Returns whether this thread now holds the mutex.
    bool lock_unless_rehearsing() {
        if (lock_if_owner()) [[likely]]
            return true;
        if (rehearsing()) return false;
        lock_without_owner();
        return true;
    }
    /// Locks without waiting, for any thread. May fail while the owner only checks whether it may enter. For
    /// std::unique_lock.
    bool try_lock() { return lock_if_owner() || try_lock_without_owner(); }
    void unlock() {
        // Another thread may write inside_ at this moment, but never this thread's id.
        if (inside_.load(std::memory_order_relaxed) != this_thread()) [[unlikely]]
            return unlock_usual_way();
        inside_.store(0, std::memory_order_release);
    }

  private:
    static constexpr int unlocked = 0, locked = 1, locked_with_waiters = 2;
    /// Values of owner_ that are not threads: there is no owner yet; there will never be an owner again.
    static constexpr std::uintptr_t nobody_yet = 0, nobody_again = 1;

    static std::uintptr_t this_thread() {
        return reinterpret_cast<std::uintptr_t>(__builtin_thread_pointer());
    }
    // Out of line, so that the code on the path of a message stays dense.
    void lock_without_owner() noexcept;
    bool try_lock_without_owner() noexcept;
    void unlock_usual_way() noexcept;
    void lock_usual_way() {
        int state = unlocked;
        if (!state_.compare_exchange_strong(state, locked, std::memory_order_acquire,
                                            std::memory_order_relaxed))
            wait_and_lock();
    }
    void wait_and_lock();
    void choose_owner(std::uintptr_t self);
    void ask_owner();
    bool owner_is_inside() const { return inside_.load(std::memory_order_acquire) != 0; }
    void tell_owner_to_stay_out();
    void count_change();

    /// The owner while it holds the mutex, else 0. Only the owner writes it, or a former owner that is about to read
    /// asked_. First member, because a thread that leaves needs no other member.
    std::atomic<std::uintptr_t> inside_{0};
    std::atomic<std::uintptr_t> owner_{
        nobody_yet}; ///< changed with the lock held the usual way, like all members below
    std::atomic<int> state_{unlocked};
    std::atomic<bool> asked_{false}; ///< another thread holds the mutex, or waits for the owner to leave
    std::uint8_t in_a_row_ = 0;      ///< how often in succession the same thread has taken the mutex
    std::uint8_t changes_ = 0;       ///< how often the thread has changed; with an owner: visits of others
    std::uint64_t last_or_since_ms_ = 0; ///< without an owner: the last thread; else since when, in ms
};

/// A std::lock_guard for a ShortMutex. Compilers often do not inline std::lock_guard into the function that uses it.
class ShortLock {
  public:
    explicit ShortLock(ShortMutex& mutex) : mutex_(mutex) { mutex_.lock(); }
    ShortLock(ShortMutex& mutex, std::adopt_lock_t) : mutex_(mutex) {}
    ShortLock(const ShortLock&) = delete;
    ShortLock& operator=(const ShortLock&) = delete;
    ~ShortLock() { mutex_.unlock(); }

  private:
    ShortMutex& mutex_;
};

} // namespace tandem::rt
