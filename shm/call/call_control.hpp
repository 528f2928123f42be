// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <cstdint>

namespace tandem::shm {

/// How other threads control and observe a call that a thread waits for. The words must stay valid until the call returns.
/// Null pointers: no control.
struct CallControl {
    const std::atomic<bool>* cancelled = nullptr; ///< true ends the call
    std::atomic<double>* progress = nullptr;      ///< receives the progress that the worker reports, 0 to 1
    std::uint64_t max_ns = 0;                     ///< replaces the timeout of the call; 0: does not
};

/// Returns the control of the calls that the calling thread makes. Called when a reply does not come at once, so that a
/// short call costs nothing more. Must not wait or throw.
using FindCallControl = CallControl (*)();

} // namespace tandem::shm
