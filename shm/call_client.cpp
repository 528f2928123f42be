// SPDX-License-Identifier: Apache-2.0
#include "shm/call_client.hpp"

#include "shm/call_slot.hpp"
#include "shm/error.hpp"
#include "shm/shared_copy.hpp"

namespace tandem::shm {
namespace {

using layout::SlotState;

constexpr auto look_after_peer = std::chrono::milliseconds(5);

CallStatus say(CallStatus status, const std::string& text, std::vector<std::byte>& results) {
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    results.assign(bytes, bytes + text.size());
    return status;
}

} // namespace

CallClient::CallClient(CallQueueHandle queue, const WaitOptions& how) : queue_(std::move(queue)), how_(how) {
    if (queue_.callers != queue_.mapping->side())
        throw Error(queue_.mapping->path() + ": a call queue for callers of side " + name_of(queue_.callers) +
                    " cannot be called here; use CallServer");
}

Reply CallClient::call(std::uint32_t operation, std::span<const std::byte> arguments,
                       std::chrono::nanoseconds timeout) {
    Reply reply{CallStatus::ok, {}};
    reply.status = call_into(operation, arguments, timeout, reply.bytes);
    return reply;
}

CallStatus CallClient::call_into(std::uint32_t operation, std::span<const std::byte> arguments,
                                 std::chrono::nanoseconds timeout, std::vector<std::byte>& results) {
    results.clear();
    if (arguments.size() > queue_.max_bytes)
        return say(CallStatus::bad_arguments,
                   "arguments of " + std::to_string(arguments.size()) + " bytes, the call queue takes " +
                       std::to_string(queue_.max_bytes),
                   results);
    if (stopped_.load(std::memory_order_relaxed) ||
        queue_.shared->closed.load(std::memory_order_relaxed) != 0)
        return CallStatus::shut_down;
    const std::uint32_t index = claim();
    if (index == no_slot) {
        queue_.shared->overloads.fetch_add(1, std::memory_order_relaxed);
        return CallStatus::overload;
    }
    const std::uint64_t deadline = deadline_after(timeout);
    submit(index, operation, arguments, deadline);
    CallStatus status = await(index, deadline);
    if (status == CallStatus::ok) status = collect(index, results);
    if (status == CallStatus::timeout) queue_.shared->timeouts.fetch_add(1, std::memory_order_relaxed);
    return status;
}

/// While this looks, slots that it has passed may become free and those ahead be taken: so it looks several
/// times before it says that there is none.
std::uint32_t CallClient::claim() {
    constexpr std::uint32_t rounds = 8;
    const std::uint32_t start = next_.fetch_add(1, std::memory_order_relaxed) % queue_.slot_count;
    for (std::uint32_t i = 0; i < rounds * queue_.slot_count; ++i) {
        const std::uint32_t index = (start + i) % queue_.slot_count;
        auto& slot = queue_.slot(index);
        const bool is_free = slot.state.load(std::memory_order_relaxed) == slot_word(SlotState::free);
        if (is_free && change_slot(slot, SlotState::free, SlotState::claimed)) return index;
    }
    return no_slot;
}

void CallClient::submit(std::uint32_t index, std::uint32_t operation, std::span<const std::byte> arguments,
                        std::uint64_t deadline) {
    auto& slot = queue_.slot(index);
    auto& shared = *queue_.shared;
    slot.operation.store(operation, std::memory_order_relaxed);
    slot.deadline_ns.store(deadline, std::memory_order_relaxed);
    slot.length.store(arguments.size(), std::memory_order_relaxed);
    copy_to_shared(queue_.buffer(index), arguments.data(), arguments.size());
    slot.ticket.store(shared.tickets.fetch_add(1, std::memory_order_relaxed), std::memory_order_relaxed);
    slot.state.store(slot_word(SlotState::submitted), std::memory_order_release);
    // As in futex.hpp: the submission and the look at `sleepers` here, the announcement and the look at
    // `submissions` there, all seq_cst; so either the worker sees the call, or this sees the worker.
    shared.submissions.fetch_add(1, std::memory_order_seq_cst);
    if (shared.sleepers.load(std::memory_order_seq_cst) != 0) futex_wake(shared.submissions, 1);
}

/// ok: there is a reply to collect. Anything else: the slot is no longer this call's.
CallStatus CallClient::await(std::uint32_t index, std::uint64_t deadline) {
    auto& slot = queue_.slot(index);
    const auto over = [&slot] {
        const std::uint32_t state = slot.state.load(std::memory_order_seq_cst);
        return state != slot_word(SlotState::submitted) && state != slot_word(SlotState::running);
    };
    WaitOptions how = how_;
    bool done = over();
    for (std::uint64_t slice = deadline_after(how.spin); !done; slice = deadline_after(look_after_peer)) {
        done = wait_until(slot.caller_sleeps, how, std::min(slice, deadline), over);
        if (done) break;
        if (queue_.mapping->peer() == PeerState::dead) return give_up(index, CallStatus::peer_died);
        if (stopped_.load(std::memory_order_relaxed)) return give_up(index, CallStatus::shut_down);
        if (now_ns() >= deadline) return give_up(index, CallStatus::timeout);
        if (how.mode == WaitMode::spin_then_futex) how.mode = WaitMode::futex; // the time to spin is over
    }
    // A state that no honest server sets would end as a damaged reply in collect().
    return CallStatus::ok;
}

/// The worker may take or answer the call at this very moment: whoever changes the state first decides.
CallStatus CallClient::give_up(std::uint32_t index, CallStatus reason) {
    auto& slot = queue_.slot(index);
    if (reason == CallStatus::peer_died) {
        slot.state.store(slot_word(SlotState::free), std::memory_order_release); // nobody else will
        return reason;
    }
    if (change_slot(slot, SlotState::submitted, SlotState::free) ||
        change_slot(slot, SlotState::running, SlotState::abandoned))
        return reason;
    return CallStatus::ok;
}

CallStatus CallClient::collect(std::uint32_t index, std::vector<std::byte>& results) {
    auto& slot = queue_.slot(index);
    const std::uint32_t state = slot.state.load(std::memory_order_acquire);
    const std::uint32_t status = slot.status.load(std::memory_order_relaxed);
    const std::uint64_t length = slot.length.load(std::memory_order_relaxed);
    if (state != slot_word(SlotState::replied) || status > static_cast<std::uint32_t>(CallStatus::shut_down) ||
        length > queue_.max_bytes)
        return say(CallStatus::exception, "the other side has damaged the reply", results);
    results.resize(length);
    copy_from_shared(results.data(), queue_.buffer(index), length);
    slot.state.store(slot_word(SlotState::free), std::memory_order_release);
    return static_cast<CallStatus>(status);
}

} // namespace tandem::shm
