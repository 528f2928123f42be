// SPDX-License-Identifier: Apache-2.0
// Internal to CallClient: what callers do with slots.
//
// The thread that owns the slot stores the request word, and a worker claims the call by another word. Only this process
// knows the owner. If a caller cancels the call and then finds no claim, the call never runs (layout.hpp). If there is a
// claim, the slot is parked until the reply comes, because a worker may still read the arguments and write results there.
#pragma once
#include "shm/call/call_view.hpp"
#include "shm/wait/sleep_until.hpp"

#include <optional>
#include <vector>

namespace tandem::shm {

enum class CallStart { ok, overload, closed, no_memory };

/// [any-thread, any number at once] The calling end of a queue. Only one thread uses a ticket.
template <class A>
class CallCaller {
  public:
    /// Withdraws the calls that an earlier CallCaller of this process has left behind.
    explicit CallCaller(const BasicCallView<A>& view) : view_(view), slots_(view.slot_count) {
        for (std::uint32_t slot = 0; slot < view_.slot_count; ++slot) {
            auto& request = view_.slots[slot].request;
            const std::uint64_t word = request.word.load(std::memory_order_acquire);
            slots_[slot].sequence = sequence_of(word);
            slots_[slot].calls = request.calls.load(std::memory_order_relaxed);
            slots_[slot].owner.store(claimed, std::memory_order_relaxed);
            slots_[slot].may_have_loan = length_of(word) > view_.short_bytes;
            if (!has_state(word, layout::CallState::forgotten) && withdraw({slot, word})) continue;
            give_back_all_loans(slot);
            release(slot, idle);
        }
    }

    /// Submits a call. `preferred`: the slot to try first, ideally the last one of this thread, whose lines are in its
    /// cache. `waits`: this thread calls sleep() if no reply comes soon. `recent`: a recent time that is exact enough for
    /// this call, to avoid reading the clock; 0 if there is none.
    CallStart begin(const void* arguments, std::size_t bytes, std::uint64_t timeout_ns,
                    std::uint32_t preferred, bool waits, CallTicket& ticket, std::uint64_t recent = 0) {
        const std::uint32_t slot = claim(preferred);
        if (slot == no_slot) return CallStart::overload;
        auto& own = slots_[slot];
        if (bytes > view_.argument_room) [[unlikely]] {
            own.may_have_loan = bytes > view_.short_bytes;
            if (!view_.prepare_long(slot, arguments, bytes, own.has_overflow)) {
                give_back_loan(slot);
                release(slot, idle);
                ticket.slot = slot;
                return CallStart::no_memory;
            }
        }
        auto& request = view_.slots[slot].request;
        own.sequence =
            own.sequence == call_sequence_mask ? 1 : own.sequence + 1; // 0 means a slot without any reply
        const std::uint64_t word = call_word(layout::CallState::submitted, own.sequence, bytes);
        const std::uint64_t now = recent == 0 || is_timed(word) ? A::now() : recent;
        ticket = {slot, word, now, now + timeout_ns, false};
        view_.copy_arguments_in(slot, arguments, bytes);
        request.submitted_ns.store(now, std::memory_order_relaxed);
        request.deadline_ns.store(ticket.deadline_ns, std::memory_order_relaxed);
        request.calls.store(++own.calls, std::memory_order_relaxed);
        // seq_cst: release for the worker that takes it; and before the loads of `closed` and `workers_asleep`
        //
        //     caller: word = submitted | closed? workers_asleep?
        //     server: closed = 1, ++workers_asleep | look at slots
        //
        // where all are seq_cst, so at least one side sees the other.
        request.word.store(ticket.word, std::memory_order_seq_cst);
        if (view_.header->closed.load(std::memory_order_seq_cst) != 0 && withdraw(ticket))
            return CallStart::closed;
        ticket.worker_woken = needs_wake(waits);
        if (ticket.worker_woken) wake_worker();
        return CallStart::ok;
    }

    bool replied(const CallTicket& ticket) const {
        // seq_cst for sleep(). It costs no more than the acquire that reading the results needs.
        const auto word = view_.slots[ticket.slot].reply.word.load(std::memory_order_seq_cst);
        return sequence_of(word) == sequence_of(ticket.word);
    }

    /// Polls until there is a reply; returns false if now() reaches `until` first.
    bool spin(const CallTicket& ticket, std::uint64_t until) const {
        for (unsigned round = 1;; ++round) {
            if (replied(ticket)) return true;
            view_.prefetch_reply(ticket.slot);
            if (round % 32 == 0 && A::now() >= until) return false;
            A::pause();
        }
    }

    /// Sleeps until there is a reply; returns false if now() reaches `until` first. If no worker has taken the call, first
    /// wakes one: begin() may have relied on a worker that was expected `soon` and has not come.
    bool sleep(CallTicket& ticket, std::uint64_t until) {
        if (!ticket.worker_woken && !claimed_by_worker(ticket) &&
            view_.header->workers_asleep.load(std::memory_order_seq_cst) != 0)
            wake_worker();
        ticket.worker_woken = false;
        return sleep_until<A>(view_.slots[ticket.slot].request.caller_asleep, until,
                              [&] { return replied(ticket); });
    }

    /// Returns the progress that the worker reports, from 0 to 1; nothing if it has not reported any.
    std::optional<double> progress(const CallTicket& ticket) const {
        const auto word = view_.slots[ticket.slot].work.progress.load(std::memory_order_relaxed);
        if (sequence_of(word) != sequence_of(ticket.word)) return std::nullopt;
        return share_of(word);
    }

    /// Gives up a call without a reply: it will not start any more, and its slot becomes free, or is parked while the call
    /// runs. Returns false if there is a reply; take it with reply() and finish().
    bool withdraw(const CallTicket& ticket) {
        if (replied(ticket)) return false;
        // seq_cst, like the load of the claim after it: the worker's counterpart is CallWorker::claim().
        view_.slots[ticket.slot].request.word.store(with_state(ticket.word, layout::CallState::cancelled),
                                                    std::memory_order_seq_cst);
        const bool runs = claimed_by_worker(ticket);
        if (!runs) give_back_loan(ticket.slot);
        release(ticket.slot, runs ? parked(sequence_of(ticket.word)) : idle);
        return true;
    }

    /// Gives up a call whose server is dead and will never access the slot again.
    void forget(const CallTicket& ticket) {
        view_.slots[ticket.slot].request.word.store(with_state(ticket.word, layout::CallState::forgotten),
                                                    std::memory_order_relaxed);
        give_back_loan(ticket.slot);
        release(ticket.slot, idle);
    }

    /// Returns the reply's word, or 0 if the word in the slot is not a reply to this call.
    std::uint64_t reply(const CallTicket& ticket) const {
        const auto word = view_.slots[ticket.slot].reply.word.load(std::memory_order_acquire);
        return sequence_of(word) == sequence_of(ticket.word) ? word : 0;
    }
    void copy_results(const CallTicket& ticket, void* to, std::size_t bytes) const {
        view_.copy_results_out(ticket.slot, to, bytes);
    }
    /// Returns whether the results, which came by loan, are as long as the peer says. copy_loan() copies them.
    bool has_loan(const CallTicket& ticket, std::size_t bytes) {
        slots_[ticket.slot].may_have_loan = true;
        return view_.loans.has(ticket.slot, bytes);
    }
    bool copy_loan(const CallTicket& ticket, void* to, std::size_t bytes) const {
        return view_.loans.read(ticket.slot, to, bytes);
    }
    /// Frees the slot after its reply was taken.
    void finish(const CallTicket& ticket) {
        give_back_loan(ticket.slot);
        release(ticket.slot, idle);
    }

  private:
    bool claimed_by_worker(const CallTicket& ticket) const {
        return is_claimed(ticket.word, view_.slots[ticket.slot].work.claim.load(std::memory_order_seq_cst));
    }

    static constexpr std::uint32_t no_slot = ~std::uint32_t{0};
    static constexpr std::uint32_t idle = 0, claimed = 1;
    static constexpr std::uint32_t parked(std::uint64_t sequence) {
        return static_cast<std::uint32_t>(sequence) << 2 | 2U;
    }

    /// This process's private state of a slot.
    struct alignas(64) Slot {
        typename A::template Atomic<std::uint32_t> owner{idle}; // idle, claimed, or parked(sequence)
        std::uint64_t sequence = 0, calls = 0;                  // of the thread that has claimed the slot
        bool has_overflow = false;                              // its buffer has memory
        bool may_have_loan = false;                             // its loan may have memory
    };

    /// Goes round several times before it finds no slot: meanwhile, slots that it has passed may become idle while those
    /// ahead are claimed.
    std::uint32_t claim(std::uint32_t preferred) {
        constexpr std::uint32_t rounds = 8;
        for (std::uint32_t i = 0; i < rounds * view_.slot_count; ++i) {
            const std::uint32_t slot = (preferred + i) % view_.slot_count;
            auto& owner = slots_[slot].owner;
            std::uint32_t seen = owner.load(std::memory_order_relaxed);
            if (seen == claimed) continue;
            // acquire: the worker has finished with the slot, and all its writes there come before this point
            if (seen != idle &&
                parked(sequence_of(view_.slots[slot].reply.word.load(std::memory_order_acquire))) != seen)
                continue;
            // acquire pairs with release(): `sequence` and `calls` are those that the previous owner left
            if (owner.compare_exchange_strong(seen, claimed, std::memory_order_acquire)) {
                if (seen != idle) [[unlikely]]
                    give_back_all_loans(slot);
                show_to_workers(slot);
                return slot;
            }
        }
        return no_slot;
    }
    /// Workers look only at slots that have been used. seq_cst like the request word, which is stored afterwards: a worker
    /// that sees this word, or must see it before it falls asleep, also looks at this slot.
    void show_to_workers(std::uint32_t slot) {
        auto& used = view_.header->slots_used;
        if ((used.load(std::memory_order_seq_cst) & slot) != slot) [[unlikely]]
            used.fetch_or(slot, std::memory_order_seq_cst);
    }
    void give_back_loan(std::uint32_t slot) {
        if (!slots_[slot].may_have_loan) [[likely]]
            return;
        slots_[slot].may_have_loan = false;
        view_.loans.give_back(slot);
    }
    /// For a call whose reply nobody has taken: its worker may have lent results.
    void give_back_all_loans(std::uint32_t slot) {
        const auto reply = view_.slots[slot].reply.word.load(std::memory_order_relaxed);
        if (length_of(reply) > view_.short_bytes) slots_[slot].may_have_loan = true;
        give_back_loan(slot);
    }
    void release(std::uint32_t slot, std::uint32_t state) {
        slots_[slot].owner.store(state, std::memory_order_release);
    }

    bool needs_wake(bool waits) const {
        using layout::WorkerPolling;
        if (view_.header->workers_asleep.load(std::memory_order_seq_cst) == 0) return false;
        const auto polling =
            static_cast<WorkerPolling>(view_.header->polling.load(std::memory_order_seq_cst));
        return !(polling == WorkerPolling::yes || (waits && polling == WorkerPolling::soon));
    }
    void wake_worker() {
        view_.header->wake_count.fetch_add(1, std::memory_order_seq_cst);
        view_.header->worker_wakes.fetch_add(1, std::memory_order_relaxed);
        A::futex_wake(view_.header->wake_count, 1);
    }

    BasicCallView<A> view_;
    std::vector<Slot> slots_;
};

} // namespace tandem::shm
