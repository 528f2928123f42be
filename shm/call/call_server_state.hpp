// SPDX-License-Identifier: Apache-2.0
// Internal to the serving end; users include call_server.hpp.
#pragma once
#include "shm/call/call_worker.hpp"
#include "shm/call/incoming_call.hpp"
#include "shm/os/recent_clock.hpp"
#include "shm/wait/adaptive_spin.hpp"

namespace tandem::shm {

/// The state that a server shares with all of its calls.
struct IncomingCall::State {
    State(const CallQueueHandle& handle, const WaitOptions& options)
        : queue(handle), how(options), max_spin_ns(bounded_ns(options.spin)), worker(handle.view) {}

    /// Takes the call that has waited longest; waits for a call at most `bound`. Returns false if none came.
    bool take(std::chrono::nanoseconds bound, TakenCall& call);

    /// Takes a call without waiting, and answers calls that must not run. Returns false if none may run.
    bool take_runnable(bool& polling, RecentClock& clock, TakenCall& call);

    void answer(const TakenCall& call, CallStatus status, std::span<const std::byte> bytes);

    const CallQueueHandle queue;
    const WaitOptions how;
    const std::uint64_t max_spin_ns;
    CallWorker<RealAtomics> worker;

  private:
    void refuse(const TakenCall& call);
    void prepare_results(const TakenCall& call, CallStatus& status, std::span<const std::byte>& bytes);

    AdaptiveSpin spin;
    std::atomic<bool> measuring{false};
};

} // namespace tandem::shm
