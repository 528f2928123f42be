// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/call/incoming_call.hpp"

namespace tandem::shm {

/// [any-thread, any number at once] The serving end of a call queue.
class CallServer {
  public:
    /// Throws Error if this side is the callers' side. `how`: how an idle worker waits; only one at a time polls.
    explicit CallServer(const CallQueueHandle& queue, const WaitOptions& how = {});
    ~CallServer(); ///< shut_down()
    CallServer(const CallServer&) = delete;
    CallServer& operator=(const CallServer&) = delete;

    /// The call that waits longest; waits for one at most `bound`. Calls whose deadline is over are not handed out.
    std::optional<IncomingCall> take(std::chrono::nanoseconds bound);

    /// Makes all workers' take() return empty at once when no call waits, now and from now on.
    void end_all_waits();

    /// Refuses all calls, also those that wait, with CallStatus::shut_down; ends the workers' waits.
    void shut_down();

    CallCounters counters() const;

  private:
    std::shared_ptr<IncomingCall::State> state_;
};

} // namespace tandem::shm
