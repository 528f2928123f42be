// SPDX-License-Identifier: Apache-2.0
// Inside of CallServer: what workers do with slots.
//
// A worker copies the arguments first and then takes the call by compare-and-swap of the whole request word.
// If that succeeds, the word was the same all the time (its sequence never comes back within reach), so the
// copy is of one call:
//
//     caller: cancels n (CAS)   writes n+1    word = submitted n+1
//     worker:    word = submitted n    copies (n, n+1 mixed)    CAS on submitted n fails: looks again
//
// Workers of one process keep off each other by `busy`, which the other side cannot reach: each slot has one
// private copy of its arguments, and one worker in it at a time whatever the shared words say.
#pragma once
#include "shm/call/call_view.hpp"
#include "shm/os/futex.hpp"

#include <climits>
#include <optional>
#include <vector>

namespace tandem::shm {

/// [any-thread, any number at once]
template <class A>
class CallWorker {
  public:
    explicit CallWorker(const BasicCallView<A>& view)
        : view_(view), words_per_slot_(round_up(view.max_bytes, word_bytes) / word_bytes),
          copies_(words_per_slot_ * view.slot_count), busy_(view.slot_count) {}

    /// The call that waits longest becomes this worker's, to be answered. `watches`: this worker is the one
    /// that polls; with a call it ceases to be.
    std::optional<TakenCall> take(bool& watches) {
        // Another worker or the caller may be faster: then look again, as often as there are slots; who loses
        // that often leaves the rest to those who won.
        for (std::uint32_t attempt = 0; attempt < view_.slot_count; ++attempt) {
            std::uint64_t word = 0;
            const std::uint32_t slot = oldest(word);
            if (slot == no_slot) return std::nullopt;
            if (busy_[slot].exchange(1, std::memory_order_acquire) != 0) continue;
            auto& request = view_.slots[slot].request;
            // The line for the compare-and-swap and the second one come while the clock is read.
            __builtin_prefetch(&request, 1);
            view_.expect_request(slot);
            const std::uint64_t running = with_state(word, layout::CallState::running);
            TakenCall taken{slot, running};
            taken.watched = watches;
            taken.taken_ns = A::now();
            taken.operation = static_cast<std::uint32_t>(request.what.load(std::memory_order_relaxed));
            taken.deadline_ns = request.deadline_ns.load(std::memory_order_relaxed);
            taken.sound = length_of(word) <= view_.max_bytes;
            taken.arguments = &copies_[slot * words_per_slot_];
            view_.get_arguments(slot, &copies_[slot * words_per_slot_], taken.bytes());
            // release: the reads above stay above
            if (request.word.compare_exchange_strong(word, running, std::memory_order_acq_rel)) {
                view_.own_reply(slot);
                leave_watch(watches);
                watches = false;
                return taken;
            }
            busy_[slot].store(0, std::memory_order_release);
        }
        return std::nullopt;
    }

    /// Ends a call that was taken. True: that took a system call.
    bool answer(const TakenCall& taken, std::uint32_t status, const void* results, std::size_t bytes) {
        auto& slot = view_.slots[taken.slot];
        view_.put_results(taken.slot, results, bytes);
        slot.reply.answered.store(slot.reply.answered.load(std::memory_order_relaxed) + 1,
                                  std::memory_order_relaxed);
        // Before the reply: from there on the caller may submit again, and another worker come in.
        busy_[taken.slot].store(0, std::memory_order_release);
        if (taken.watched) expect_back();
        // seq_cst: release for the caller that reads the results; and against its announcement of sleep
        slot.reply.word.store(call_word(status, sequence_of(taken.word), bytes), std::memory_order_seq_cst);
        return wake<A>(slot.request.caller_sleeps);
    }

    /// Has the caller of a call that was taken given up?
    bool cancelled(const TakenCall& taken) const {
        return view_.slots[taken.slot].request.word.load(std::memory_order_relaxed) != taken.word;
    }

    /// Becomes the worker that polls, if no other is. It sees a call quickest; more would only heat cores.
    bool watch() {
        if (spinning_.exchange(1, std::memory_order_seq_cst) != 0) return false;
        set_watching(layout::CallWatch::yes);
        return true;
    }
    /// The end of watch() without a call.
    void stop_watching() {
        spinning_.store(0, std::memory_order_seq_cst);
        set_watching(layout::CallWatch::no);
    }

    /// Polls until there is a call to take or interrupted(); false: now() has reached `until`. It does not
    /// ask for the second line of the next call, as a caller does for its reply's: measured, that takes the
    /// line from the caller while it is being written.
    bool spin(std::uint64_t until) const {
        for (unsigned round = 1;; ++round) {
            if (any_submitted() || interrupted()) return true;
            if (round % 32 == 0 && A::now() >= until) return false;
            A::pause();
        }
    }

    /// Sleeps until there may be a call, or interrupt(), or now() reaches `until`.
    ///
    ///     worker: ++sleepers, r = rung | calls? sleep(r)    caller: word = submitted | sleepers? ++rung,
    ///     wake
    ///
    /// All seq_cst: either the worker sees the call, or the caller sees the sleeper; and then the kernel sees
    /// that rung is no longer r. If a colleague has been polling and has left with a call while nobody slept
    /// yet, `watching` still says yes; so who lies down corrects it (or the poller is back, and sees all).
    void sleep(std::uint64_t until) {
        auto& header = *view_.header;
        header.sleepers.fetch_add(1, std::memory_order_seq_cst);
        if (spinning_.load(std::memory_order_seq_cst) == 0) set_watching(layout::CallWatch::no);
        const std::uint32_t rung = header.rung.load(std::memory_order_seq_cst);
        if (!any_submitted() && !interrupted()) A::futex_wait(header.rung, rung, until);
        header.sleepers.fetch_sub(1, std::memory_order_seq_cst);
    }

    /// Ends all waits of this object's workers, now and from now on.
    void interrupt() {
        interrupted_.store(1, std::memory_order_seq_cst);
        view_.header->rung.fetch_add(1, std::memory_order_seq_cst);
        A::futex_wake(view_.header->rung, INT_MAX);
    }
    bool interrupted() const { return interrupted_.load(std::memory_order_seq_cst) != 0; }

    /// Callers that begin after close() see it; those before are seen by take() (call_caller.hpp, begin()).
    void open() { view_.header->closed.store(0, std::memory_order_relaxed); }
    void close() { view_.header->closed.store(1, std::memory_order_seq_cst); }
    bool closed() const { return view_.header->closed.load(std::memory_order_relaxed) != 0; }

    /// The callers are dead: what none of them waits for is not run.
    void drop_submitted() {
        for (std::uint32_t slot = 0; slot < view_.slot_count; ++slot) {
            auto& request = view_.slots[slot].request;
            std::uint64_t word = request.word.load(std::memory_order_relaxed);
            if (has_state(word, layout::CallState::submitted))
                request.word.compare_exchange_strong(word, with_state(word, layout::CallState::cancelled),
                                                     std::memory_order_relaxed);
        }
    }

  private:
    static constexpr std::uint32_t no_slot = ~std::uint32_t{0};

    bool submitted(std::uint32_t slot) const {
        return has_state(view_.slots[slot].request.word.load(std::memory_order_seq_cst),
                         layout::CallState::submitted);
    }
    bool any_submitted() const {
        for (std::uint32_t slot = 0; slot < view_.slot_count; ++slot)
            if (submitted(slot)) return true;
        return false;
    }

    std::uint32_t ticket(std::uint32_t slot) const {
        return static_cast<std::uint32_t>(view_.slots[slot].request.what.load(std::memory_order_relaxed) >>
                                          32);
    }

    /// Of the submitted calls, outside of slots in which a worker still is, the one with the oldest ticket.
    std::uint32_t oldest(std::uint64_t& word) const {
        std::uint32_t found = no_slot;
        for (std::uint32_t slot = 0; slot < view_.slot_count; ++slot) {
            // seq_cst: acquire, the call's arguments are there; and after close(), see CallCaller::begin().
            const std::uint64_t seen = view_.slots[slot].request.word.load(std::memory_order_seq_cst);
            if (!has_state(seen, layout::CallState::submitted) ||
                busy_[slot].load(std::memory_order_relaxed) != 0)
                continue;
            // The difference, not the order: tickets wrap around.
            if (found != no_slot && static_cast<std::int32_t>(ticket(slot) - ticket(found)) >= 0) continue;
            found = slot;
            word = seen;
        }
        return found;
    }

    /// Stored only if it changes: callers look at it with every call.
    void set_watching(layout::CallWatch watch) {
        const auto value = static_cast<std::uint32_t>(watch);
        auto& watching = view_.header->watching;
        if (watching.load(std::memory_order_relaxed) != value)
            watching.store(value, std::memory_order_seq_cst);
    }

    /// A worker that polled is about to poll again: a caller that is quicker need not wake another one.
    void expect_back() {
        auto& watching = view_.header->watching;
        if (view_.header->sleepers.load(std::memory_order_relaxed) != 0 &&
            watching.load(std::memory_order_relaxed) == static_cast<std::uint32_t>(layout::CallWatch::no))
            watching.store(static_cast<std::uint32_t>(layout::CallWatch::soon), std::memory_order_relaxed);
    }

    /// Goes off with a call. While all others are awake nobody needs to be told; otherwise callers have to
    /// wake one from now on, and this worker wakes one for those calls whose callers still relied on it.
    void leave_watch(bool watched) {
        auto& header = *view_.header;
        if (watched) spinning_.store(0, std::memory_order_seq_cst);
        if (header.sleepers.load(std::memory_order_seq_cst) == 0) return;
        if (watched) set_watching(layout::CallWatch::no);
        if (!any_submitted()) return;
        header.rung.fetch_add(1, std::memory_order_seq_cst);
        A::futex_wake(header.rung, 1);
    }

    BasicCallView<A> view_;
    std::size_t words_per_slot_;
    std::vector<std::uint64_t> copies_;
    std::vector<typename A::template Atomic<std::uint32_t>> busy_; // 1 = a worker is in the slot
    typename A::template Atomic<std::uint32_t> spinning_{0}, interrupted_{0};
};

} // namespace tandem::shm
