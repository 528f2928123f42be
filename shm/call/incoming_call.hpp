// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/call/call_queue.hpp"
#include "shm/wait/wait_options.hpp"

#include <optional>

namespace tandem::shm {

/// A call that a worker has taken and must answer exactly once. Answers CallStatus::exception if destroyed without an
/// answer. May outlive its CallServer.
class IncomingCall {
  public:
    struct State;
    /// For CallServer, the only class with a State: creates an empty object that take() fills.
    explicit IncomingCall(std::shared_ptr<State> server) : server_(std::move(server)) {}
    IncomingCall(IncomingCall&& from) noexcept = default;
    IncomingCall& operator=(IncomingCall&&) = delete;
    ~IncomingCall() {
        if (server_) [[unlikely]]
            reply_not_answered();
    }

    /// Returns a private copy; valid until reply().
    std::span<const std::byte> arguments() const {
        return {static_cast<const std::byte*>(taken_.arguments), taken_.bytes()};
    }

    /// Returns whether nobody waits for the reply any more: the caller has cancelled the call, its deadline has passed, or
    /// the queue was shut down. The call must be answered nevertheless: until then its slot is in use. Two loads.
    bool cancelled() const;
    /// Reports the progress of the call, from 0 to 1. One store.
    void set_progress(double share);

    /// Replies with results, or with the text of an error. Results that are too long for the queue become
    /// CallStatus::exception.
    void reply(CallStatus status, std::span<const std::byte> bytes);
    void reply(CallStatus status, const std::string& text = {});

  private:
    friend class CallServer;
    void reply_not_answered();

    std::shared_ptr<State> server_; // empty if answered, moved from, or without a call
    TakenCall taken_;
};

} // namespace tandem::shm
