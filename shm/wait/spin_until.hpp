// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/atomics.hpp"

namespace tandem::shm {

/// Polls ready() until it holds or A::now() reaches `deadline` (then false). Reads the clock seldom, and pauses
/// between rounds only after it has polled for long: a pause takes 50 ns, by which the reaction would be late.
template <class A = RealAtomics, class Ready>
bool spin_until(std::uint64_t deadline, Ready&& ready) {
    for (unsigned round = 1;; ++round) {
        if (ready()) return true;
        if (round % A::rounds_per_clock == 0 && A::now() >= deadline) return false;
        if (round > A::eager_rounds) A::pause();
    }
}

/// The same, but gives the core to other threads between two rounds.
template <class A = RealAtomics, class Ready>
bool yield_until(std::uint64_t deadline, Ready&& ready) {
    for (unsigned round = 1;; ++round) {
        if (ready()) return true;
        A::yield();
        if (round % 16 == 0 && A::now() >= deadline) return ready();
    }
}

} // namespace tandem::shm
