// SPDX-License-Identifier: Apache-2.0
// Inside of CallClient: what callers do with slots.
//
// Who may change the request word. From idle to submitted: the thread that has claimed the slot (claims are
// known to this process alone). After that two compare-and-swaps on it compete,
//
//     worker: submitted -> running          caller: submitted -> cancelled
//
// and one of them wins: a call that was cancelled before it ran never runs. A running call is *abandoned*:
// the worker learns it by the word and answers nevertheless; until then the slot is parked, because that
// worker still writes its results there.
#pragma once
#include "shm/call/call_view.hpp"
#include "shm/os/futex.hpp"

#include <vector>

namespace tandem::shm {

enum class CallStart { ok, overload, closed };

/// [any-thread, any number at once] A ticket is used by one thread at a time, except for cancel().
template <class A>
class CallCaller {
  public:
    /// Calls left by an earlier CallCaller of this process are withdrawn.
    explicit CallCaller(const BasicCallView<A>& view) : view_(view), mine_(view.slot_count) {
        for (std::uint32_t slot = 0; slot < view_.slot_count; ++slot) {
            auto& request = view_.slots[slot].request;
            const std::uint64_t word = request.word.load(std::memory_order_acquire);
            mine_[slot].sequence = sequence_of(word);
            mine_[slot].calls = request.calls.load(std::memory_order_relaxed);
            mine_[slot].owner.store(taken, std::memory_order_relaxed);
            const CallTicket left{slot, with_state(word, layout::CallState::submitted)};
            if (!withdraw(left)) done(left);
        }
    }

    /// Submits a call. `prefer`: the slot to try first, best the one that this thread had last: its lines are
    /// near. `waits`: this thread goes on to wait() at once. `recent`: a time not long ago that is
    /// exact enough for this call; 0 if there is none.
    CallStart begin(std::uint32_t operation, const void* arguments, std::size_t bytes, std::uint64_t timeout,
                    std::uint32_t prefer, bool waits, CallTicket& ticket, std::uint64_t recent = 0) {
        const std::uint32_t slot = claim(prefer);
        if (slot == no_slot) return CallStart::overload;
        auto& mine = mine_[slot];
        auto& request = view_.slots[slot].request;
        mine.sequence = mine.sequence == sequence_mask ? 1 : mine.sequence + 1; // 0 is a slot without reply
        const std::uint64_t word = call_word(layout::CallState::submitted, mine.sequence, bytes);
        const std::uint64_t now = recent == 0 || is_timed(word) ? A::now() : recent;
        ticket = {slot, word, now, now + timeout, false};
        // Relaxed and word-wise: a worker may still be reading the call before, which was cancelled. Its
        // compare-and-swap fails then, whatever it has read.
        view_.put_arguments(slot, arguments, bytes);
        request.what.store((now / 1000) << 32 | operation, std::memory_order_relaxed);
        request.deadline_ns.store(ticket.deadline_ns, std::memory_order_relaxed);
        request.calls.store(++mine.calls, std::memory_order_relaxed);
        // seq_cst: release for the worker that takes it; and before the looks at `closed` and `sleepers`
        //
        //     caller: word = submitted | closed? sleepers?    server: closed = 1, ++sleepers | look at slots
        //
        // where all are seq_cst, so at least one side sees the other.
        request.word.store(ticket.word, std::memory_order_seq_cst);
        if (view_.header->closed.load(std::memory_order_seq_cst) != 0 && withdraw(ticket))
            return CallStart::closed;
        ticket.rung = someone_must_wake(waits);
        if (ticket.rung) ring();
        return CallStart::ok;
    }

    /// Has the reply come?
    bool replied(const CallTicket& ticket) const {
        // seq_cst for sleep(); costs nothing over acquire, which the reading of the results needs.
        const auto word = view_.slots[ticket.slot].reply.word.load(std::memory_order_seq_cst);
        return sequence_of(word) == sequence_of(ticket.word);
    }

    /// A reply or a cancel: the call needs no more waiting.
    bool over(const CallTicket& ticket) const { return replied(ticket) || cancelled(ticket); }

    /// Polls until there is a reply or a cancel (true), or until now() reaches `until`. The request word is
    /// looked at seldom: the worker is about to write its line.
    bool spin(const CallTicket& ticket, std::uint64_t until) const {
        for (unsigned round = 1;; ++round) {
            if (replied(ticket)) return true;
            view_.expect_reply(ticket.slot);
            if (round % 32 == 0) {
                if (cancelled(ticket)) return true;
                if (A::now() >= until) return false;
            }
            A::pause();
        }
    }

    /// The same, asleep. If no worker has taken the call, one is woken before: begin() may have relied on one
    /// that was expected `soon`, and the next sleep of this call on one that did not come.
    bool sleep(CallTicket& ticket, std::uint64_t until) {
        auto& request = view_.slots[ticket.slot].request;
        if (!ticket.rung && request.word.load(std::memory_order_seq_cst) == ticket.word &&
            view_.header->sleepers.load(std::memory_order_seq_cst) != 0)
            ring();
        ticket.rung = false;
        return sleep_until<A>(request.caller_sleeps, until, [&] { return over(ticket); });
    }

    /// [any-thread] Ends a call whose reply has not come, and the wait for it. Does nothing to a later call
    /// of the same slot: its word has another sequence.
    void cancel(const CallTicket& ticket) {
        auto& request = view_.slots[ticket.slot].request;
        std::uint64_t seen = ticket.word;
        if (request.word.compare_exchange_strong(seen, with_state(seen, layout::CallState::cancelled),
                                                 std::memory_order_seq_cst) ||
            (seen == with_state(ticket.word, layout::CallState::running) &&
             request.word.compare_exchange_strong(seen, with_state(seen, layout::CallState::abandoned),
                                                  std::memory_order_seq_cst)))
            wake<A>(request.caller_sleeps);
    }

    /// Gives the slot back without a reply. False: there is one, or nothing but damage; collect() it.
    bool withdraw(const CallTicket& ticket) {
        if (replied(ticket)) return false;
        cancel(ticket);
        const auto word = view_.slots[ticket.slot].request.word.load(std::memory_order_relaxed);
        if (word == with_state(ticket.word, layout::CallState::cancelled)) {
            release(ticket.slot, idle);
            return true;
        }
        if (word != with_state(ticket.word, layout::CallState::abandoned) || replied(ticket)) return false;
        release(ticket.slot, parked(sequence_of(ticket.word)));
        return true;
    }

    /// The server is dead and will never touch the slot again.
    void forget(const CallTicket& ticket) {
        view_.slots[ticket.slot].request.word.store(with_state(ticket.word, layout::CallState::cancelled),
                                                    std::memory_order_relaxed);
        release(ticket.slot, idle);
    }

    /// The reply's word, or 0 if what stands there is not a reply to this call.
    std::uint64_t reply(const CallTicket& ticket) const {
        const auto word = view_.slots[ticket.slot].reply.word.load(std::memory_order_acquire);
        return sequence_of(word) == sequence_of(ticket.word) ? word : 0;
    }
    void copy_results(const CallTicket& ticket, void* to, std::size_t bytes) const {
        view_.get_results(ticket.slot, to, bytes);
    }
    void done(const CallTicket& ticket) { release(ticket.slot, idle); }

  private:
    static constexpr std::uint32_t no_slot = ~std::uint32_t{0};
    static constexpr std::uint32_t idle = 0, taken = 1;
    static constexpr std::uint32_t parked(std::uint64_t sequence) {
        return static_cast<std::uint32_t>(sequence) << 2 | 2U;
    }

    struct alignas(64) Mine {
        typename A::template Atomic<std::uint32_t> owner{idle}; // idle, taken, or parked(sequence)
        std::uint64_t sequence = 0, calls = 0;                  // the owner's
    };

    bool cancelled(const CallTicket& ticket) const {
        const auto word = view_.slots[ticket.slot].request.word.load(std::memory_order_seq_cst);
        return word != ticket.word && word != with_state(ticket.word, layout::CallState::running);
    }

    /// While this looks, slots that it has passed may become idle and those ahead be taken: so it looks
    /// several times before it says that there is none.
    std::uint32_t claim(std::uint32_t prefer) {
        constexpr std::uint32_t rounds = 8;
        for (std::uint32_t i = 0; i < rounds * view_.slot_count; ++i) {
            const std::uint32_t slot = (prefer + i) % view_.slot_count;
            auto& owner = mine_[slot].owner;
            std::uint32_t seen = owner.load(std::memory_order_relaxed);
            if (seen == taken) continue;
            // acquire: the worker is done with the slot, all that it has written there is before us
            if (seen != idle &&
                parked(sequence_of(view_.slots[slot].reply.word.load(std::memory_order_acquire))) != seen)
                continue;
            // acquire against release(): `sequence` and `calls` of the owner before
            if (owner.compare_exchange_strong(seen, taken, std::memory_order_acquire)) return slot;
        }
        return no_slot;
    }
    void release(std::uint32_t slot, std::uint32_t state) {
        mine_[slot].owner.store(state, std::memory_order_release);
    }

    bool someone_must_wake(bool waits) const {
        if (view_.header->sleepers.load(std::memory_order_seq_cst) == 0) return false;
        const auto watching =
            static_cast<layout::CallWatch>(view_.header->watching.load(std::memory_order_seq_cst));
        return !(watching == layout::CallWatch::yes || (waits && watching == layout::CallWatch::soon));
    }
    void ring() {
        view_.header->rung.fetch_add(1, std::memory_order_seq_cst);
        view_.header->worker_wakes.fetch_add(1, std::memory_order_relaxed);
        A::futex_wake(view_.header->rung, 1);
    }

    BasicCallView<A> view_;
    std::vector<Mine> mine_;
};

} // namespace tandem::shm
