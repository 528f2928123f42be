// SPDX-License-Identifier: Apache-2.0
// Inside of the serving end; users include call_server.hpp.
#pragma once
#include "shm/call_server.hpp"
#include "shm/call_slot.hpp"

namespace tandem::shm {

/// What all calls of one server share: the queue, and one private argument buffer per slot.
struct IncomingCall::State {
    explicit State(CallQueueHandle handle);

    /// Reserves a slot's private buffer. False: a worker of this server still uses it, so the other side has
    /// tampered with the slot's state.
    bool enter(std::uint32_t index) { return !busy[index].exchange(true, std::memory_order_acquire); }

    /// Copies a running slot's call out of shared memory. False: it is longer than the queue takes.
    bool load(std::uint32_t index, std::uint32_t& operation, std::uint64_t& deadline,
              std::span<const std::byte>& arguments);
    void answer(std::uint32_t index, CallStatus status, std::span<const std::byte> bytes);

    CallQueueHandle queue;
    std::vector<std::uint64_t> buffers;
    std::size_t words_per_slot;
    std::vector<std::atomic<bool>> busy;
};

} // namespace tandem::shm
