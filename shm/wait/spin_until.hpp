// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/atomics.hpp"

namespace tandem::shm {

/// Polls until ready() holds. Returns false if A::now(), in ns, reaches `deadline` first. Seldom reads the clock, and pauses
/// between rounds only after a long time of polling: a pause delays the reaction by 50 ns.
template <class A = RealAtomics, class Ready>
bool spin_until(std::uint64_t deadline, Ready&& ready) {
    for (unsigned round = 1;; ++round) {
        if (ready()) return true;
        if (round % A::rounds_per_clock == 0 && A::now() >= deadline) return false;
        if (round > A::eager_rounds) A::pause();
    }
}

/// Polls like spin_until(), but yields the core to other threads between rounds.
template <class A = RealAtomics, class Ready>
bool yield_until(std::uint64_t deadline, Ready&& ready) {
    for (unsigned round = 1;; ++round) {
        if (ready()) return true;
        A::yield();
        if (round % 16 == 0 && A::now() >= deadline) return ready();
    }
}

} // namespace tandem::shm
