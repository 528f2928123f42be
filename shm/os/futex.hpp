// SPDX-License-Identifier: Apache-2.0
// Sleeping on a shared word, and the protocol that lets the waking side do without a system call.
#pragma once
#include "shm/os/atomics.hpp"

namespace tandem::shm {

/// Sleeps while `word` holds `expected`, until woken or now_ns() reaches `deadline`. May return early. A long
/// sleep sets no timer (sleep_alarm.hpp).
void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline);

/// The bare system calls. False: `longest_ns` passed.
bool futex_wait_timed(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t longest_ns);
void futex_wait_forever(std::atomic<std::uint32_t>& word, std::uint32_t expected);
void futex_wake(std::atomic<std::uint32_t>& word, int sleepers);

/// How to wait: spin polls only, futex sleeps at once, spin_then_futex polls for `spin` and then sleeps.
/// same_core, for two processes pinned to one core: yields the core to the other for `spin`, and then sleeps;
/// neither side has to be woken as long as they answer each other.
enum class WaitMode { spin, spin_then_futex, futex, same_core };
struct WaitOptions {
    WaitMode mode = WaitMode::spin_then_futex;
    std::chrono::nanoseconds spin = std::chrono::microseconds(50);
};

/// Sleeps of one wait, which take no longer than `bound` together (give or take a tick of the coarse clock).
/// The exact clock is never read: a sleep ends by itself, and a second one starts from the coarse clock.
class BoundedSleep {
  public:
    explicit BoundedSleep(std::chrono::nanoseconds bound);

    /// Sleeps while `word` holds `expected`; may return early. False: the bound has passed.
    bool on(std::atomic<std::uint32_t>& word, std::uint32_t expected);

  private:
    std::uint64_t bound_ns_, started_ns_;
    bool first_ = true;
};

/// Polls ready() until it holds or now_ns() reaches `deadline`. Looks at the clock seldom, and pauses only
/// when it has polled for long: a pause takes 50 ns here, by which the news would be late.
template <class A = RealAtomics, class Ready>
bool spin_until(std::uint64_t deadline, Ready&& ready) {
    for (unsigned round = 1;; ++round) {
        if (ready()) return true;
        if (round % A::rounds_per_clock == 0 && A::now() >= deadline) return false;
        if (round > A::eager_rounds) A::pause();
    }
}

/// The same with the core given to whoever else wants it between two looks.
template <class A = RealAtomics, class Ready>
bool yield_until(std::uint64_t deadline, Ready&& ready) {
    for (unsigned round = 1;; ++round) {
        if (ready()) return true;
        A::yield();
        if (round % 16 == 0 && A::now() >= deadline) return ready();
    }
}

/// One sleeper, any number of wakers, one word. Sleeper: announces (word = 1), looks again, sleeps. Waker:
/// makes its data visible by a seq_cst write, then wake(). All four accesses are seq_cst, so of the two
/// orders
///
///     sleeper: word = 1 | ready()?            waker: data | word == 1?
///
/// at least one side sees the other: either ready() holds and nobody sleeps, or the waker sees the
/// announcement. The kernel compares the word again, so a wake between ready() and the sleep is not lost
/// either.
template <class A = RealAtomics, class Ready>
bool sleep_until(typename A::template Atomic<std::uint32_t>& word, std::uint64_t deadline, Ready&& ready) {
    bool done = false;
    while (!done) {
        word.store(1, std::memory_order_seq_cst);
        done = ready();
        if (done || A::now() >= deadline) break;
        A::futex_wait(word, 1, deadline);
        done = ready();
    }
    word.store(0, std::memory_order_relaxed);
    return done;
}

/// Wakes the sleeper if there is one. True: that took a system call.
template <class A = RealAtomics>
bool wake(typename A::template Atomic<std::uint32_t>& word) {
    if (word.load(std::memory_order_seq_cst) == 0 || word.exchange(0, std::memory_order_seq_cst) == 0)
        return false;
    A::futex_wake(word, 1);
    return true;
}

/// Waits until ready() holds, in the way asked for, at most until `deadline`. ready() must load with seq_cst.
template <class A = RealAtomics, class Ready>
bool wait_until(typename A::template Atomic<std::uint32_t>& word, const WaitOptions& how,
                std::uint64_t deadline, Ready&& ready) {
    if (ready()) return true;
    if (how.mode == WaitMode::spin) return spin_until<A>(deadline, ready);
    const auto spin = static_cast<std::uint64_t>(how.spin.count());
    if (how.mode == WaitMode::spin_then_futex && spin_until<A>(std::min(deadline, A::now() + spin), ready))
        return true;
    if (how.mode == WaitMode::same_core && yield_until<A>(std::min(deadline, A::now() + spin), ready))
        return true;
    return sleep_until<A>(word, deadline, ready);
}

} // namespace tandem::shm
