// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>

namespace tandem::shm {

/// How to wait. spin: only polls. futex: sleeps at once. spin_then_futex: polls for WaitOptions::spin, then sleeps.
/// same_core, for two processes pinned to one core: yields the core to the peer for WaitOptions::spin, then sleeps; neither
/// side needs a wake-up while the two answer each other.
enum class WaitMode { spin, spin_then_futex, futex, same_core };

struct WaitOptions {
    WaitMode mode = WaitMode::spin_then_futex;
    std::chrono::nanoseconds spin = std::chrono::microseconds(50);
    /// For callers: uses the slots of the queue in turn, whichever thread calls, so that an observer finds the last calls
    /// there (inspect/call_follower.hpp). Otherwise a thread reuses the slot that is in its cache.
    bool keep_history = false;
};

} // namespace tandem::shm
