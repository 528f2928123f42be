// SPDX-License-Identifier: Apache-2.0
// Inside of the call queue: sleep_until() and wake() of futex.hpp (the protocol is explained there) over the
// atomics policy.
#pragma once
#include "shm/atomics.hpp"

namespace tandem::shm {

template <class A, class Ready>
bool sleep_on(typename A::template Atomic<std::uint32_t>& word, std::uint64_t deadline, Ready&& ready) {
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

/// True: that took a system call.
template <class A>
bool wake_sleeper(typename A::template Atomic<std::uint32_t>& word) {
    if (word.load(std::memory_order_seq_cst) == 0 || word.exchange(0, std::memory_order_seq_cst) == 0)
        return false;
    A::futex_wake(word, 1);
    return true;
}

} // namespace tandem::shm
