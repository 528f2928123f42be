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

/// Provides the memory for the results of a call.
class ResultMemory {
  public:
    /// Returns exactly `bytes` bytes, valid until the next call. Their earlier content may be lost.
    virtual std::span<std::byte> room_for(std::size_t bytes) = 0;

  protected:
    ~ResultMemory() = default;
};

/// A reply in memory of the caller.
struct ReplyView {
    CallStatus status;
    std::span<const std::byte> bytes;
};

/// [any-thread, any number at once] The calling end of a call queue; a queue has one at a time.
class CallClient {
  public:
    /// `how`: how a caller waits for its reply. `find_control`: how calls are cancelled and report progress; may be null.
    /// Throws Error if this side is not the callers' side, or another CallClient has this queue.
    explicit CallClient(const CallQueueHandle& queue, const WaitOptions& how = {},
                        FindCallControl find_control = nullptr);
    ~CallClient();
    CallClient(CallClient&&) noexcept;
    CallClient& operator=(CallClient&&) = delete;

    /// Sends the arguments to the peer and waits for the reply, at most `timeout`, which may end 1 % early from 10 ms on.
    /// Status timeout: the call may have run, but will not start any more. overload: no slot became free in this time, and
    /// the call has not run. peer_died, cancelled: noticed within 5 ms. A cancelled call that has not started never starts.
    Reply call(std::span<const std::byte> arguments, std::chrono::nanoseconds timeout);

    /// Calls like call(), with the results in the caller's memory.
    ReplyView call_into(std::span<const std::byte> arguments, std::chrono::nanoseconds timeout,
                        ResultMemory& memory);
    /// Calls like call(), with the results in the caller's buffer. Allocates nothing once the capacity suffices.
    CallStatus call_into(std::span<const std::byte> arguments, std::chrono::nanoseconds timeout,
                         std::vector<std::byte>& results);

    /// Ends all current calls within 5 ms, and all later ones, with CallStatus::shut_down.
    void shut_down();

    CallCounters counters() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace tandem::shm
