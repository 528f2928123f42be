// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/call/incoming_call.hpp"

namespace tandem::shm {

/// [any-thread, any number at once] The serving end of a call queue.
class CallServer {
  public:
    /// `how`: how an idle worker waits; only one worker at a time polls. Throws Error if this side is the callers' side.
    explicit CallServer(const CallQueueHandle& queue, const WaitOptions& how = {});
    ~CallServer(); ///< Calls shut_down().
    CallServer(const CallServer&) = delete;
    CallServer& operator=(const CallServer&) = delete;

    /// Returns the call that has waited longest; waits for a call at most `bound`. Does not return calls whose deadline has
    /// passed.
    std::optional<IncomingCall> take(std::chrono::nanoseconds bound);

    /// Makes take() of all workers return empty at once when no call waits, from now on.
    void end_all_waits();

    /// Refuses all calls, including waiting ones, with CallStatus::shut_down. Ends the workers' waits.
    void shut_down();

    CallCounters counters() const;

  private:
    std::shared_ptr<IncomingCall::State> state_;
};

} // namespace tandem::shm
