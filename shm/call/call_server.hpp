// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/call/call_queue.hpp"
#include "shm/os/futex.hpp"

#include <optional>

namespace tandem::shm {

/// A call taken by a worker, to be answered exactly once. Destroyed unanswered, it answers
/// CallStatus::exception.
class IncomingCall {
  public:
    IncomingCall(IncomingCall&& from) noexcept = default;
    IncomingCall& operator=(IncomingCall&&) = delete;
    ~IncomingCall();

    std::uint32_t operation() const { return taken_.operation; }
    std::span<const std::byte> arguments() const { ///< A private copy; valid until reply().
        return {static_cast<const std::byte*>(taken_.arguments), taken_.bytes()};
    }
    std::uint64_t deadline_ns() const { return taken_.deadline_ns; } ///< of now_ns()

    /// The caller has given up (deadline, cancel, shut-down): nobody waits for the reply any more.
    /// [any-thread]
    bool cancelled() const;

    /// Results, or the text of an error. Results longer than the queue takes become CallStatus::exception.
    void reply(CallStatus status, std::span<const std::byte> bytes);
    void reply(CallStatus status, const std::string& text = {});

  private:
    friend class CallServer;
    struct State;
    IncomingCall(std::shared_ptr<State> server, const TakenCall& taken)
        : server_(std::move(server)), taken_(taken) {}

    std::shared_ptr<State> server_; // empty once answered (or moved from)
    TakenCall taken_;
};

/// [any-thread, any number at once] The serving end of a call queue.
class CallServer {
  public:
    /// Throws Error if this side is the callers' side. `how`: how an idle worker waits; only one at a time
    /// spins.
    explicit CallServer(const CallQueueHandle& queue, const WaitOptions& how = {});
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
    std::shared_ptr<IncomingCall::State> state_;
};

} // namespace tandem::shm
