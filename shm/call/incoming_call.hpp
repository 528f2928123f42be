// SPDX-License-Identifier: Apache-2.0
// Inside of the serving end; users include call_server.hpp.
#pragma once
#include "shm/call/call_server.hpp"
#include "shm/call/call_worker.hpp"
#include "shm/wait/adaptive_spin.hpp"

namespace tandem::shm {

/// What all calls of one server share.
struct IncomingCall::State {
    State(const CallQueueHandle& handle, const WaitOptions& options)
        : queue(handle), how(options), spin_ns(bounded_ns(options.spin)), worker(handle.view) {}

    std::optional<TakenCall> take(std::chrono::nanoseconds bound);
    std::optional<TakenCall> take_waiting(bool& watches);
    void answer(const TakenCall& call, CallStatus status, std::span<const std::byte> bytes);

    const CallQueueHandle queue;
    const WaitOptions how;
    const std::uint64_t spin_ns;
    CallWorker<RealAtomics> worker;

  private:
    AdaptiveSpin spin;
    std::atomic<bool> timing{false};
};

} // namespace tandem::shm
