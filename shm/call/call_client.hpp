// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/call/call_control.hpp"
#include "shm/call/call_queue.hpp"
#include "shm/wait/wait_options.hpp"

#include <span>
#include <vector>

namespace tandem::shm {

struct Reply {
    CallStatus status;
    std::vector<std::byte> bytes; ///< the results, or the text of the error
    std::string text() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
};

/// Where the results of a call go.
class ResultMemory {
  public:
    /// Exactly that many bytes, valid until the next call. What they held may be lost.
    virtual std::span<std::byte> room_for(std::size_t bytes) = 0;

  protected:
    ~ResultMemory() = default;
};

/// The same as Reply, in the memory given.
struct ReplyView {
    CallStatus status;
    std::span<const std::byte> bytes;
};

/// [any-thread, any number at once] The calling end of a call queue; a queue has one at a time.
class CallClient {
  public:
    /// Throws Error if this side is not the callers' side, or another CallClient has this queue. `how`: how a
    /// caller waits for its reply. `find_control`: how calls are cancelled and asked for their progress, may be null.
    explicit CallClient(const CallQueueHandle& queue, const WaitOptions& how = {},
                        FindCallControl find_control = nullptr);
    ~CallClient();
    CallClient(CallClient&&) noexcept;
    CallClient& operator=(CallClient&&) = delete;

    /// Sends the arguments to the peer and waits for the reply, at most `timeout` (if that is 10 ms or more,
    /// it may end 1 % early). CallStatus::timeout: whether the call ran is unknown, but it will not start any
    /// more. overload: no slot was free, it has not run. peer_died, cancelled: found out within 5 ms. A cancelled call that
    /// has not begun does not start any more.
    Reply call(std::span<const std::byte> arguments, std::chrono::nanoseconds timeout);

    /// The same, into memory of the caller's.
    ReplyView call_into(std::span<const std::byte> arguments, std::chrono::nanoseconds timeout,
                        ResultMemory& memory);
    /// The same, into a buffer of the caller's: no allocation once its capacity suffices.
    CallStatus call_into(std::span<const std::byte> arguments, std::chrono::nanoseconds timeout,
                         std::vector<std::byte>& results);

    /// Ends all calls within 5 ms, and all later ones, with CallStatus::shut_down.
    void shut_down();

    CallCounters counters() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace tandem::shm
