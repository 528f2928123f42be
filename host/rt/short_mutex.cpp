// SPDX-License-Identifier: Apache-2.0
#include "host/rt/short_mutex.hpp"

#include <chrono>
#include <linux/membarrier.h>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>

namespace tandem::rt {
namespace {

// A thread that takes the mutex this often, without another thread in between, becomes its owner.
constexpr std::uint8_t in_a_row_for_owner = 16;
// A mutex that has changed hands this often gets no owner. An owner that other threads have asked this often within a
// second loses the mutex, because asking costs a system call. Occasional requests, for example from a peer that is
// restarted, do not add up.
constexpr std::uint8_t changes_for_nobody = 64;
constexpr std::uint64_t counted_ms = 1000;

std::uint64_t clock_ms() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

/// Returns whether the threads of this process can be made to pass a barrier. The thread sanitizer does not know such
/// barriers.
bool has_barrier() {
#ifdef __SANITIZE_THREAD__
    return false;
#else
    static const bool registered =
        syscall(SYS_membarrier, MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED, 0, 0) == 0;
    return registered;
#endif
}

/// When this returns, each running thread of the process has passed a full memory barrier.
void pass_barrier_in_all_threads() {
    if (syscall(SYS_membarrier, MEMBARRIER_CMD_PRIVATE_EXPEDITED, 0, 0) == 0) return;
    // A new seccomp filter may forbid the call after the registration. Stores reach the cache in far less time than
    // this sleep.
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

} // namespace

void ShortMutex::wait_and_lock() {
    // The thread that gets the lock here cannot know whether others still wait. It therefore leaves the state that
    // makes unlock() wake a waiter.
    while (state_.exchange(locked_with_waiters, std::memory_order_acquire) != unlocked)
        state_.wait(locked_with_waiters, std::memory_order_relaxed);
}

void ShortMutex::lock_without_owner() noexcept {
    lock_usual_way();
    const std::uintptr_t owner = owner_.load(std::memory_order_relaxed);
    if (owner == nobody_again) [[likely]]
        return;
    const std::uintptr_t self = this_thread();
    if (owner == nobody_yet)
        choose_owner(self);
    else if (owner != self)
        ask_owner();
}

bool ShortMutex::try_lock_without_owner() noexcept {
    int state = unlocked;
    if (!state_.compare_exchange_strong(state, locked, std::memory_order_acquire, std::memory_order_relaxed))
        return false;
    const std::uintptr_t owner = owner_.load(std::memory_order_relaxed), self = this_thread();
    if (owner == nobody_yet) {
        choose_owner(self);
    } else if (owner != nobody_again && owner != self) {
        tell_owner_to_stay_out();
        if (owner_is_inside()) {
            unlock_usual_way();
            return false;
        }
        count_change();
    }
    return true;
}

void ShortMutex::unlock_usual_way() noexcept {
    const std::uintptr_t owner = owner_.load(std::memory_order_relaxed);
    if (owner > nobody_again && owner != this_thread()) asked_.store(false, std::memory_order_release);
    if (state_.exchange(unlocked, std::memory_order_release) == locked_with_waiters) [[unlikely]]
        state_.notify_one();
}

/// Called with the lock held the usual way. The lock stays held the usual way, even if this thread becomes the owner
/// here.
void ShortMutex::choose_owner(std::uintptr_t self) {
    if (last_or_since_ms_ != self) {
        last_or_since_ms_ = self;
        in_a_row_ = 0;
        if (++changes_ == changes_for_nobody) owner_.store(nobody_again, std::memory_order_relaxed);
    } else if (++in_a_row_ == in_a_row_for_owner) {
        owner_.store(has_barrier() ? self : nobody_again, std::memory_order_relaxed);
        last_or_since_ms_ = 0;
    }
}

/// Called by a thread that is not the owner, with the lock held the usual way. Returns when the owner is not inside and
/// cannot enter before unlock(). If the owner loses the mutex here, it can never enter again without the lock.
void ShortMutex::ask_owner() {
    tell_owner_to_stay_out();
    for (int looks = 0; owner_is_inside(); ++looks) {
        constexpr int quick_looks = 100;
        if (looks < quick_looks)
            std::this_thread::yield();
        else // sleeps instead of yielding: the owner may have a lower priority than this thread
            std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
    count_change();
}

/// When this returns, the owner has either left its name in inside_ or will not enter.
void ShortMutex::tell_owner_to_stay_out() {
    asked_.store(true, std::memory_order_seq_cst);
    pass_barrier_in_all_threads();
}

/// Called with the lock held, after the owner has left.
void ShortMutex::count_change() {
    if (const std::uint64_t now = clock_ms(); now - last_or_since_ms_ >= counted_ms) {
        last_or_since_ms_ = now;
        changes_ = 0;
    }
    // After this store asked_ stays set, because the owner may still find its name in owner_.
    if (++changes_ == changes_for_nobody) owner_.store(nobody_again, std::memory_order_relaxed);
}

} // namespace tandem::rt
