// SPDX-License-Identifier: Apache-2.0
#include "shm/incoming_call.hpp"

#include "shm/shared_copy.hpp"

namespace tandem::shm {

using layout::SlotState;

IncomingCall::State::State(CallQueueHandle handle)
    : queue(std::move(handle)), words_per_slot(round_up(queue.max_bytes, word_bytes) / word_bytes),
      busy(queue.slot_count) {
    buffers.resize(words_per_slot * queue.slot_count);
}

bool IncomingCall::State::load(std::uint32_t index, std::uint32_t& operation, std::uint64_t& deadline,
                               std::span<const std::byte>& arguments) {
    const auto& slot = queue.slot(index);
    operation = slot.operation.load(std::memory_order_relaxed);
    deadline = slot.deadline_ns.load(std::memory_order_relaxed);
    const std::uint64_t length = slot.length.load(std::memory_order_relaxed);
    if (length > queue.max_bytes) return false;
    auto* copy = reinterpret_cast<std::byte*>(buffers.data() + index * words_per_slot);
    copy_from_shared(copy, queue.buffer(index), length);
    arguments = {copy, length};
    return true;
}

void IncomingCall::State::answer(std::uint32_t index, CallStatus status, std::span<const std::byte> bytes) {
    auto& slot = queue.slot(index);
    queue.shared->answered.fetch_add(1, std::memory_order_relaxed);
    slot.status.store(static_cast<std::uint32_t>(status), std::memory_order_relaxed);
    slot.length.store(bytes.size(), std::memory_order_relaxed);
    copy_to_shared(queue.buffer(index), bytes.data(), bytes.size());
    busy[index].store(false, std::memory_order_release);
    // seq_cst against the caller's announcement of its sleep (futex.hpp).
    std::uint32_t expected = slot_word(SlotState::running);
    if (slot.state.compare_exchange_strong(expected, slot_word(SlotState::replied),
                                           std::memory_order_seq_cst))
        wake(slot.caller_sleeps);
    else
        change_slot(slot, SlotState::abandoned, SlotState::free);
}

IncomingCall::IncomingCall(std::shared_ptr<State> server, std::uint32_t index)
    : server_(std::move(server)), index_(index) {}

IncomingCall::~IncomingCall() {
    if (server_) reply(CallStatus::exception, "the call was not answered");
}

void IncomingCall::reply(CallStatus status, std::span<const std::byte> bytes) {
    if (!server_) return;
    if (bytes.size() > server_->queue.max_bytes)
        return reply(status == CallStatus::ok ? CallStatus::exception : status,
                     "a result of " + std::to_string(bytes.size()) + " bytes, the call queue takes " +
                         std::to_string(server_->queue.max_bytes));
    server_->answer(index_, status, bytes);
    server_.reset();
}

void IncomingCall::reply(CallStatus status, const std::string& text) {
    if (!server_) return;
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    reply(status, std::span(bytes, std::min<std::size_t>(text.size(), server_->queue.max_bytes)));
}

} // namespace tandem::shm
