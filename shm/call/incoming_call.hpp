// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/call/call_queue.hpp"
#include "shm/wait/wait_options.hpp"

#include <optional>

namespace tandem::shm {

/// A call taken by a worker, to be answered exactly once. Destroyed unanswered, it answers
/// CallStatus::exception. It may outlive its CallServer.
class IncomingCall {
  public:
    struct State;
    /// For CallServer, which alone has a State: waits for the call that it is going to be.
    explicit IncomingCall(std::shared_ptr<State> server) : server_(std::move(server)) {}
    IncomingCall(IncomingCall&& from) noexcept = default;
    IncomingCall& operator=(IncomingCall&&) = delete;
    ~IncomingCall() {
        if (server_) [[unlikely]]
            reply_not_answered();
    }

    /// A private copy; valid until reply().
    std::span<const std::byte> arguments() const {
        return {static_cast<const std::byte*>(taken_.arguments), taken_.bytes()};
    }

    /// Whether nobody waits for the reply any more: the caller has cancelled the call or its deadline is over, or the queue
    /// was shut down. The call has to be answered all the same: until then its slot is in use. Two loads.
    bool cancelled() const;
    /// Says how far the call is: 0 to 1. One store.
    void set_progress(double share);

    /// Results, or the text of an error. Results longer than the queue takes become CallStatus::exception.
    void reply(CallStatus status, std::span<const std::byte> bytes);
    void reply(CallStatus status, const std::string& text = {});

  private:
    friend class CallServer;
    [[gnu::cold]] void reply_not_answered();

    std::shared_ptr<State> server_; // empty once answered (or moved from, or when there was none)
    TakenCall taken_;
};

} // namespace tandem::shm
