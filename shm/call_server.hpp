// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/call_queue.hpp"
#include "shm/futex.hpp"

#include <optional>

namespace tandem::shm {

/// A call taken by a worker, to be answered exactly once. Destroyed unanswered, it answers
/// CallStatus::exception.
class IncomingCall {
  public:
    IncomingCall(IncomingCall&& from) noexcept = default;
    IncomingCall& operator=(IncomingCall&&) = delete;
    ~IncomingCall();

    std::uint32_t operation() const { return operation_; }
    std::span<const std::byte> arguments() const {
        return arguments_;
    }                                                       ///< a private copy; valid until reply()
    std::uint64_t deadline_ns() const { return deadline_; } ///< of now_ns()

    /// Results, or the text of an error. Results longer than the queue takes become CallStatus::exception.
    void reply(CallStatus status, std::span<const std::byte> bytes);
    void reply(CallStatus status, const std::string& text = {});

  private:
    friend class CallServer;
    struct State;
    IncomingCall(std::shared_ptr<State> server, std::uint32_t index);

    std::shared_ptr<State> server_; // empty once answered (or moved from)
    std::uint32_t index_, operation_ = 0;
    std::uint64_t deadline_ = 0;
    std::span<const std::byte> arguments_;
};

/// [any-thread, any number at once] The serving end of a call queue.
class CallServer {
  public:
    /// Throws Error if this side is the callers' side. `how`: how an idle worker waits; only one at a time
    /// spins.
    explicit CallServer(CallQueueHandle queue, const WaitOptions& how = {});
    ~CallServer(); ///< shut_down()
    CallServer(const CallServer&) = delete;
    CallServer& operator=(const CallServer&) = delete;

    /// The call that waits longest; waits for one at most `bound`. Calls whose deadline is over are not
    /// handed out.
    std::optional<IncomingCall> take(std::chrono::nanoseconds bound);

    /// All workers' take() return empty at once when nothing waits, now and from now on.
    void interrupt();

    /// Refuses all calls, those waiting included, with CallStatus::shut_down; interrupts the workers.
    void shut_down();

    CallCounters counters() const;

  private:
    std::optional<IncomingCall> take_waiting();
    std::uint32_t claim_oldest();
    void wait_for_submission(std::uint32_t seen, std::uint64_t deadline);
    void free_slots_of_dead_callers();

    std::shared_ptr<IncomingCall::State> state_;
    WaitOptions how_;
    std::atomic<bool> interrupted_{false};
    std::atomic<bool> spinning_{false};
};

} // namespace tandem::shm
