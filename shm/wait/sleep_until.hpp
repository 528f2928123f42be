// SPDX-License-Identifier: Apache-2.0
// One sleeper and any number of wakers on one word. A waker makes a system call only if there is a sleeper.
//
// The sleeper announces itself (word = 1), looks again, and sleeps. The waker makes its data visible by a
// seq_cst write and then calls wake_sleeper(). All four accesses are seq_cst, so of the two orders
//
//     sleeper: word = 1 | ready()?            waker: data | word == 1?
//
// at least one side sees the other: either ready() holds and nobody sleeps, or the waker sees the announcement. The
// kernel compares the word again, so a wake-up between ready() and the sleep is not lost either.
#pragma once
#include "shm/os/bounded_sleep.hpp"

namespace tandem::shm {

/// Sleeps until ready() holds. Returns false if A::now(), in ns, reaches `deadline` first. ready() must load with seq_cst.
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

/// Wakes the sleeper if there is one. Returns true if it made a system call.
template <class A = RealAtomics>
bool wake_sleeper(typename A::template Atomic<std::uint32_t>& word) {
    if (word.load(std::memory_order_seq_cst) == 0 || word.exchange(0, std::memory_order_seq_cst) == 0)
        return false;
    A::futex_wake(word, 1);
    return true;
}

} // namespace tandem::shm
