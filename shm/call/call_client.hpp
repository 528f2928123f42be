// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/call/call_queue.hpp"
#include "shm/os/futex.hpp"

namespace tandem::shm {

struct Reply {
    CallStatus status;
    std::vector<std::byte> bytes; ///< the results, or the text of the error
    std::string text() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
};

class PendingCall;

/// [any-thread, any number at once] The calling end of a call queue; a queue has one at a time.
class CallClient {
  public:
    /// Throws Error if this side is not the callers' side, or another CallClient has this queue. `how`: how a
    /// caller waits for its reply.
    explicit CallClient(const CallQueueHandle& queue, const WaitOptions& how = {});

    /// Runs an operation on the other side and waits for its reply, at most `timeout` (of 10 ms and
    /// more up to 1 % less). timeout: whether it
    /// ran is unknown, but it will not start any more. overload: no slot was free, it has not run. peer_died:
    /// within 5 ms.
    Reply call(std::uint32_t operation, std::span<const std::byte> arguments,
               std::chrono::nanoseconds timeout);

    /// The same, into a buffer of the caller's: no allocation once its capacity suffices.
    CallStatus call_into(std::uint32_t operation, std::span<const std::byte> arguments,
                         std::chrono::nanoseconds timeout, std::vector<std::byte>& results);

    /// Submits a call and goes on. `timeout` runs from here. Errors come out of PendingCall::wait().
    PendingCall begin(std::uint32_t operation, std::span<const std::byte> arguments,
                      std::chrono::nanoseconds timeout);

    /// Ends all calls within 5 ms, and all later ones, with CallStatus::shut_down.
    void shut_down();

    CallCounters counters() const;

  private:
    friend class PendingCall;
    friend class CancelToken;
    struct State;
    std::shared_ptr<State> state_;
};

/// [any-thread] Ends one call with CallStatus::cancelled: it will not start any more; if it runs already, its
/// worker may learn of it (IncomingCall::cancelled). After the call's end it does nothing.
class CancelToken {
  public:
    void cancel() const;

  private:
    friend class PendingCall;
    std::weak_ptr<CallClient::State> client_; // a token does not keep the client alive
    CallTicket ticket_;
};

/// [one thread at a time] A call begun and not yet waited for. Destroyed before, it cancels the call.
class PendingCall {
  public:
    PendingCall(PendingCall&& from) noexcept = default;
    PendingCall& operator=(PendingCall&&) = delete;
    ~PendingCall();

    bool ready() const; ///< wait() will return at once
    Reply wait();       ///< Once.
    CallStatus wait_into(std::vector<std::byte>& results);

    void cancel(); ///< wait() returns CallStatus::cancelled, unless the reply was there before.
    CancelToken token() const;

  private:
    friend class CallClient;
    explicit PendingCall(std::shared_ptr<CallClient::State> client) : client_(std::move(client)) {}

    std::shared_ptr<CallClient::State> client_; // empty once waited for (or moved from)
    CallTicket ticket_;
    CallStatus refused_ = CallStatus::ok; // if not, it was never submitted, for this
    std::vector<std::byte> reason_;       // and that text
};

} // namespace tandem::shm
