// SPDX-License-Identifier: Apache-2.0
#include "shm/call_server.hpp"

#include "shm/error.hpp"
#include "shm/incoming_call.hpp"
#include "shm/shared_copy.hpp"

#include <climits>

namespace tandem::shm {

using layout::SlotState;

namespace {

constexpr std::uint32_t no_slot = ~std::uint32_t{0};

} // namespace

CallServer::CallServer(CallQueueHandle queue, const WaitOptions& how) : how_(how) {
    if (queue.callers == queue.mapping->side())
        throw Error(queue.mapping->path() + ": a call queue for callers of side " + name_of(queue.callers) +
                    " cannot be served here; use CallClient");
    state_ = std::make_shared<IncomingCall::State>(std::move(queue));
    state_->queue.shared->closed.store(0, std::memory_order_relaxed);
}

CallServer::~CallServer() { shut_down(); }

CallCounters CallServer::counters() const { return read_counters(state_->queue); }

/// Marks the oldest submitted call as running. Another worker or the caller may be faster: then look again,
/// as often as there are slots; who loses that often leaves the rest to those who won.
std::uint32_t CallServer::claim_oldest() {
    const auto& queue = state_->queue;
    for (std::uint32_t attempt = 0; attempt < queue.slot_count; ++attempt) {
        std::uint32_t oldest = no_slot;
        std::uint64_t oldest_ticket = 0;
        for (std::uint32_t i = 0; i < queue.slot_count; ++i) {
            if (queue.slot(i).state.load(std::memory_order_acquire) != slot_word(SlotState::submitted))
                continue;
            const std::uint64_t ticket = queue.slot(i).ticket.load(std::memory_order_relaxed);
            if (oldest != no_slot && ticket >= oldest_ticket) continue;
            oldest = i;
            oldest_ticket = ticket;
        }
        if (oldest == no_slot) return no_slot;
        if (change_slot(queue.slot(oldest), SlotState::submitted, SlotState::running)) return oldest;
    }
    return no_slot;
}

std::optional<IncomingCall> CallServer::take_waiting() {
    auto& shared = *state_->queue.shared;
    for (std::uint32_t i = 0; i < state_->queue.slot_count; ++i) {
        const std::uint32_t index = claim_oldest();
        if (index == no_slot) break;
        if (!state_->enter(index)) continue;
        shared.taken.fetch_add(1, std::memory_order_relaxed);
        IncomingCall call(state_, index);
        if (!state_->load(call.index_, call.operation_, call.deadline_, call.arguments_))
            call.reply(CallStatus::bad_arguments, "longer than the call queue takes");
        else if (shared.closed.load(std::memory_order_relaxed) != 0)
            call.reply(CallStatus::shut_down);
        else if (now_ns() >= call.deadline_)
            call.reply(CallStatus::timeout);
        else
            return call;
    }
    return std::nullopt;
}

std::optional<IncomingCall> CallServer::take(std::chrono::nanoseconds bound) {
    const std::uint64_t deadline = deadline_after(bound);
    for (;;) {
        const std::uint32_t seen = state_->queue.shared->submissions.load(std::memory_order_seq_cst);
        if (auto call = take_waiting()) return call;
        if (interrupted_.load(std::memory_order_seq_cst)) return std::nullopt;
        if (now_ns() >= deadline) break;
        wait_for_submission(seen, deadline);
    }
    free_slots_of_dead_callers();
    return std::nullopt;
}

/// Returns when `submissions` is no longer `seen` (a call, or an interrupt), or at the deadline, or early.
/// One worker spins at a time: it answers the next call quickest, and the others would only heat cores.
void CallServer::wait_for_submission(std::uint32_t seen, std::uint64_t deadline) {
    auto& shared = *state_->queue.shared;
    const auto changed = [&] { return shared.submissions.load(std::memory_order_seq_cst) != seen; };
    if (how_.mode == WaitMode::spin) {
        spin_until(deadline, changed);
        return;
    }
    if (how_.mode == WaitMode::spin_then_futex && !spinning_.exchange(true, std::memory_order_relaxed)) {
        const bool found = spin_until(std::min(deadline, deadline_after(how_.spin)), changed);
        spinning_.store(false, std::memory_order_relaxed);
        if (found) return;
    }
    shared.sleepers.fetch_add(1, std::memory_order_seq_cst);
    if (!changed()) futex_wait(shared.submissions, seen, deadline);
    shared.sleepers.fetch_sub(1, std::memory_order_seq_cst);
}

void CallServer::interrupt() {
    interrupted_.store(true, std::memory_order_seq_cst);
    auto& submissions = state_->queue.shared->submissions;
    submissions.fetch_add(1, std::memory_order_seq_cst);
    futex_wake(submissions, INT_MAX);
}

void CallServer::shut_down() {
    state_->queue.shared->closed.store(1, std::memory_order_seq_cst);
    take_waiting(); // hands nothing out, now that the queue is closed
    interrupt();
}

/// Callers live in one process: when it is dead, so are all of them. Running calls free their slots when
/// answered.
void CallServer::free_slots_of_dead_callers() {
    const auto& queue = state_->queue;
    if (queue.mapping->peer() != PeerState::dead) return;
    for (std::uint32_t i = 0; i < queue.slot_count; ++i)
        for (const auto left : {SlotState::claimed, SlotState::submitted, SlotState::replied})
            change_slot(queue.slot(i), left, SlotState::free);
}

} // namespace tandem::shm
