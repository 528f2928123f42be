// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/call_queue.hpp"
#include "shm/futex.hpp"

namespace tandem::shm {

struct Reply {
    CallStatus status;
    std::vector<std::byte> bytes; ///< the results, or the text of the error
    std::string text() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
};

/// [any-thread, any number at once] The calling end of a call queue.
class CallClient {
  public:
    /// Throws Error if this side is not the callers' side. `how`: how a caller waits for its reply.
    explicit CallClient(CallQueueHandle queue, const WaitOptions& how = {});

    /// Runs an operation on the other side and waits for its reply, at most `timeout`. timeout: whether it
    /// ran is unknown, but it will not start any more. overload: no slot was free, it has not run. peer_died:
    /// within 5 ms.
    Reply call(std::uint32_t operation, std::span<const std::byte> arguments,
               std::chrono::nanoseconds timeout);

    /// The same, into a buffer of the caller's: no allocation once its capacity suffices.
    CallStatus call_into(std::uint32_t operation, std::span<const std::byte> arguments,
                         std::chrono::nanoseconds timeout, std::vector<std::byte>& results);

    /// Ends all calls within 5 ms, and all later ones, with CallStatus::shut_down.
    void shut_down() { stopped_.store(true, std::memory_order_relaxed); }

    CallCounters counters() const { return read_counters(queue_); }

  private:
    static constexpr std::uint32_t no_slot = ~std::uint32_t{0};

    std::uint32_t claim();
    void submit(std::uint32_t index, std::uint32_t operation, std::span<const std::byte> arguments,
                std::uint64_t deadline);
    CallStatus await(std::uint32_t index, std::uint64_t deadline);
    CallStatus give_up(std::uint32_t index, CallStatus reason);
    CallStatus collect(std::uint32_t index, std::vector<std::byte>& results);

    CallQueueHandle queue_;
    WaitOptions how_;
    std::atomic<std::uint32_t> next_{0};
    std::atomic<bool> stopped_{false};
};

} // namespace tandem::shm
