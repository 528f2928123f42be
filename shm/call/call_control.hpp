// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <cstdint>

namespace tandem::shm {

/// What other threads want of a call that a thread waits for, and learn of it. The words must stay valid until the call
/// returns; without them nobody wants anything.
struct CallControl {
    const std::atomic<bool>* cancelled = nullptr; ///< true: the call ends
    std::atomic<double>* progress = nullptr;      ///< gets what the worker says, 0 to 1
    std::uint64_t max_ns = 0;                     ///< bound of the call instead of its timeout; 0: none
};

/// The control of the calls that the calling thread makes. It is asked for when a reply does not come at once, so that a
/// short call costs nothing more. Must not wait or throw.
using FindCallControl = CallControl (*)();

} // namespace tandem::shm
