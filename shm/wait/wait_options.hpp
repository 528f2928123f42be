// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>

namespace tandem::shm {

/// How to wait: spin polls only, futex sleeps at once, spin_then_futex polls for WaitOptions::spin and then
/// sleeps. same_core, for two processes pinned to one core: yields the core to the peer for
/// WaitOptions::spin, and then sleeps; neither side has to be woken as long as they answer each other.
enum class WaitMode { spin, spin_then_futex, futex, same_core };

struct WaitOptions {
    WaitMode mode = WaitMode::spin_then_futex;
    std::chrono::nanoseconds spin = std::chrono::microseconds(50);
    /// Of a caller: calls go through the slots of the queue in turn, whichever thread makes them, so that an observer finds
    /// the last ones there (inspect/call_follower.hpp). Otherwise a thread stays in the slot that is in its cache.
    bool keep_history = false;
};

} // namespace tandem::shm
