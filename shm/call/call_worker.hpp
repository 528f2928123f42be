// SPDX-License-Identifier: Apache-2.0
// Internal to CallServer: what workers do with slots.
//
// Workers of one process exclude each other from a slot by `busy`, which the peer cannot reach. Each slot has one private
// copy of its arguments, and at most one worker at a time, whatever the shared words say. A worker claims a call by a word
// in a line that no caller polls (layout.hpp): a compare-and-swap on the request word would fetch the caller's line once
// more, which takes as long as the whole transfer of the arguments.
#pragma once
#include "shm/call/call_view.hpp"
#include "shm/wait/sleep_until.hpp"

#include <algorithm>
#include <climits>
#include <memory>
#include <new>
#include <optional>
#include <vector>

namespace tandem::shm {

/// [any-thread, any number at once] The serving end of a queue.
template <class A>
class CallWorker {
  public:
    explicit CallWorker(const BasicCallView<A>& view)
        : view_(view), words_per_slot_(round_up(view.short_bytes, word_bytes) / word_bytes),
          copies_(std::make_unique_for_overwrite<std::uint64_t[]>(words_per_slot_ * view.slot_count)),
          busy_(view.slot_count), slots_(view.slot_count) {}

    /// Takes the call that has waited longest; the caller must answer it. Returns false if there is none. `polling`:
    /// whether this worker is the one that polls; becomes false when it gets a call.
    bool take(bool& polling, TakenCall& taken) {
        // Another worker or the caller may be faster: then look again, up to once per slot. A worker that loses that often
        // leaves the rest to the winners.
        for (std::uint32_t attempt = 0; attempt < view_.slot_count; ++attempt) {
            const std::uint32_t slot = find_oldest();
            if (slot == no_slot) return false;
            if (busy_[slot].exchange(1, std::memory_order_acquire) != 0) continue;
            if (claim(slot, taken, polling)) {
                taken.by_poller = polling;
                leave_with_call(polling);
                polling = false;
                return true;
            }
            busy_[slot].store(0, std::memory_order_release);
        }
        return false;
    }

    /// Prepares results that are longer than the slot's own room. Returns false if there is no memory for them.
    bool prepare_results(const TakenCall& taken, const void* results, std::size_t bytes) {
        return view_.prepare_long(taken.slot, results, bytes, slots_[taken.slot].has_overflow);
    }

    /// Returns whether nobody waits for the results of a taken call: its caller has given it up, or the queue is closed.
    bool unwanted(const TakenCall& taken) const { return given_up(taken) || closed(); }
    bool given_up(const TakenCall& taken) const {
        return view_.slots[taken.slot].request.word.load(std::memory_order_relaxed) != taken.word;
    }
    /// Reports the progress of a call that was taken and is not answered yet; `share` is from 0 to 1.
    void set_progress(const TakenCall& taken, double share) {
        view_.slots[taken.slot].work.progress.store(progress_word(sequence_of(taken.word), share),
                                                    std::memory_order_relaxed);
    }

    /// Answers a call that was taken. Returns true if that took a system call.
    bool answer(const TakenCall& taken, CallStatus status, const void* results, std::size_t bytes) {
        auto& slot = view_.slots[taken.slot];
        view_.copy_results_in(taken.slot, results, bytes);
        if (taken.by_loan || bytes > view_.short_bytes) [[unlikely]]
            forget_loans(taken);
        slot.work.answered.store(slot.work.answered.load(std::memory_order_relaxed) + 1,
                                 std::memory_order_relaxed);
        // Must come before the reply: after it the caller may submit again, and another worker may enter the slot.
        busy_[taken.slot].store(0, std::memory_order_release);
        if (taken.by_poller) announce_return();
        // seq_cst: release for the caller that reads the results, and before the check whether the caller sleeps
        slot.reply.word.store(call_word(status, sequence_of(taken.word), bytes), std::memory_order_seq_cst);
        return wake_sleeper<A>(slot.request.caller_asleep);
    }

    /// Makes this worker the one that polls. Returns false if another worker polls: one poller sees a call soonest, and
    /// more of them would only use more cores.
    bool try_become_poller() {
        if (has_poller_.exchange(1, std::memory_order_seq_cst) != 0) return false;
        announce(layout::WorkerPolling::yes);
        return true;
    }
    /// Ends polling without a call.
    void stop_polling() {
        has_poller_.store(0, std::memory_order_seq_cst);
        announce(layout::WorkerPolling::no);
    }

    /// Polls until there is a call to take or waits_ended() holds; returns false if now() reaches `until` first. Unlike a
    /// caller it does not prefetch the second line of the next request: measurements show that this takes the line from the
    /// caller while the caller writes it.
    bool spin(std::uint64_t until) const {
        for (unsigned round = 1;; ++round) {
            if (any_submitted() || waits_ended()) return true;
            if (round % 32 == 0 && A::now() >= until) return false;
            A::pause();
        }
    }

    /// Sleeps until there may be a call, or end_all_waits(), or now() reaches `until`.
    ///
    ///     worker: ++workers_asleep, w = wake_count | calls? sleep(w)
    ///     caller: word = submitted | workers_asleep? wake
    ///
    /// All seq_cst: either the worker sees the call, or the caller sees the sleeper; and then the kernel sees
    /// that wake_count is no longer w. If the poller took a call and left before anybody slept, `polling`
    /// still is yes. So a worker that is about to sleep corrects it, unless the poller is back and sees all calls.
    void sleep(std::uint64_t until) {
        auto& header = *view_.header;
        header.workers_asleep.fetch_add(1, std::memory_order_seq_cst);
        if (has_poller_.load(std::memory_order_seq_cst) == 0) announce(layout::WorkerPolling::no);
        const std::uint32_t wake_count = header.wake_count.load(std::memory_order_seq_cst);
        if (!any_submitted() && !waits_ended()) A::futex_wait(header.wake_count, wake_count, until);
        header.workers_asleep.fetch_sub(1, std::memory_order_seq_cst);
    }

    /// Ends the current and all later waits of this object's workers.
    void end_all_waits() {
        waits_ended_.store(1, std::memory_order_seq_cst);
        // A large odd number: however often this is called, the count must not return to a value that a worker has read
        // before it sleeps, nor reach that value from 0, the count in a truncated file.
        view_.header->wake_count.fetch_add(0x9E3779B1U, std::memory_order_seq_cst);
        A::futex_wake(view_.header->wake_count, INT_MAX);
    }
    bool waits_ended() const { return waits_ended_.load(std::memory_order_seq_cst) != 0; }

    /// Accepts calls. An earlier server may have closed the queue.
    void open() { view_.header->closed.store(0, std::memory_order_relaxed); }
    /// Refuses calls. Callers that begin afterwards see it; take() finds calls that were submitted before (CallCaller::begin()).
    void close() { view_.header->closed.store(1, std::memory_order_seq_cst); }
    bool closed() const { return view_.header->closed.load(std::memory_order_relaxed) != 0; }

    /// Cancels the calls that are not running. The callers are dead, so nobody waits for these calls.
    void drop_submitted() {
        for (std::uint32_t slot = 0; slot < view_.slot_count; ++slot) {
            auto& request = view_.slots[slot].request;
            std::uint64_t word = request.word.load(std::memory_order_relaxed);
            if (waits(view_.slots[slot], word))
                request.word.compare_exchange_strong(word, with_state(word, layout::CallState::cancelled),
                                                     std::memory_order_relaxed);
        }
    }

  private:
    static constexpr std::uint32_t no_slot = ~std::uint32_t{0};

    /// Most queues use one or a few slots: each caller prefers the slot that it used last. See
    /// CallCaller::show_to_workers().
    std::uint32_t slots_in_use() const {
        const std::uint32_t last = view_.header->slots_used.load(std::memory_order_seq_cst);
        return std::min(last, view_.slot_count - 1) + 1;
    }

    /// Returns whether a call waits in the slot. A request word does not change until the next call; the claim shows
    /// whether the call was taken. seq_cst: acquire makes the call's arguments visible; after close(), see
    /// CallCaller::begin(). An outdated claim makes a worker look once more.
    static bool waits(const layout::BasicCallSlot<A>& slot, std::uint64_t word) {
        return has_state(word, layout::CallState::submitted) &&
               !is_claimed(word, slot.work.claim.load(std::memory_order_relaxed));
    }
    static bool waits(const layout::BasicCallSlot<A>& slot) {
        return waits(slot, slot.request.word.load(std::memory_order_seq_cst));
    }

    bool any_submitted() const {
        const auto* slot = view_.slots;
        const auto* const end = slot + slots_in_use();
        for (; slot != end; ++slot)
            if (waits(*slot)) return true;
        return false;
    }

    /// Takes the call of a slot that no other worker is in, and copies its arguments. Returns false if another worker has
    /// run it since it was found, or its caller has cancelled it. One fence serves both the claim and the end of polling:
    /// leave_with_call().
    bool claim(std::uint32_t index, TakenCall& taken, bool& polling) {
        auto& slot = view_.slots[index];
        const std::uint64_t word = slot.request.word.load(std::memory_order_relaxed);
        if (!waits(slot, word)) return false;
        view_.prefetch_request(index); // the second line of the arguments
        // release: a worker that reads it also sees what this worker has announced.
        if (polling) has_poller_.store(0, std::memory_order_release);
        // Must come before the load of the word: the caller's counterpart is CallCaller::withdraw().
        slot.work.claim.store(call_word(0U, sequence_of(word), 0), std::memory_order_relaxed);
        A::fence();
        if (slot.request.word.load(std::memory_order_relaxed) != word) {
            // The caller may have seen the claim, and keeps the slot until there is a reply. Nothing was read or written.
            slot.reply.word.store(call_word(CallStatus::cancelled, sequence_of(word), 0),
                                  std::memory_order_relaxed);
            if (polling && has_poller_.exchange(1, std::memory_order_seq_cst) != 0) polling = false;
            return false;
        }
        view_.prefetch_reply_for_writing(index);
        taken.slot = index;
        taken.word = word;
        taken.deadline_ns = slot.request.deadline_ns.load(std::memory_order_relaxed);
        taken.by_loan = length_of(word) > view_.short_bytes;
        if (taken.by_loan) [[unlikely]] {
            copy_loan(index, taken);
            return true;
        }
        taken.valid = true;
        taken.arguments = &copies_[index * words_per_slot_];
        view_.copy_arguments_out(index, &copies_[index * words_per_slot_], length_of(word));
        return true;
    }

    /// Copies arguments that came by loan. They are not valid if they are too long for the queue, or the peer has not written
    /// them, or this process has no memory for them.
    void copy_loan(std::uint32_t index, TakenCall& taken) {
        const std::uint64_t bytes = length_of(taken.word);
        taken.valid = false;
        taken.arguments = nullptr;
        if (bytes > view_.max_bytes || !view_.loans.has(index, bytes)) return;
        auto& copy = slots_[index].long_arguments;
        copy.reset(new (std::nothrow) std::uint64_t[round_up(bytes, word_bytes) / word_bytes]);
        taken.valid = copy && view_.loans.read(index, copy.get(), bytes);
        taken.arguments = copy.get();
    }

    /// A caller that has given up may not come back to this slot, and then gives no memory back.
    void forget_loans(const TakenCall& taken) {
        slots_[taken.slot].long_arguments.reset();
        if (given_up(taken)) view_.loans.give_back(taken.slot);
    }

    /// Finds the call that was submitted first, except in slots that another worker is in.
    std::uint32_t find_oldest() const {
        std::uint32_t oldest = no_slot;
        std::uint64_t oldest_ns = 0;
        const auto* const slots = view_.slots;
        const std::uint32_t count = slots_in_use();
        for (std::uint32_t slot = 0; slot < count; ++slot) {
            if (!waits(slots[slot])) [[likely]]
                continue;
            if (busy_[slot].load(std::memory_order_relaxed) != 0) continue;
            const std::uint64_t submitted_ns =
                slots[slot].request.submitted_ns.load(std::memory_order_relaxed);
            if (oldest != no_slot && submitted_ns >= oldest_ns) continue;
            oldest = slot;
            oldest_ns = submitted_ns;
        }
        return oldest;
    }

    /// Stores only a changed value, because callers read it with every call.
    void announce(layout::WorkerPolling state) {
        const auto value = static_cast<std::uint32_t>(state);
        auto& polling = view_.header->polling;
        if (polling.load(std::memory_order_relaxed) != value) polling.store(value, std::memory_order_seq_cst);
    }

    /// Announces that the poller has answered and will poll again: a faster caller need not wake another worker.
    void announce_return() {
        auto& polling = view_.header->polling;
        if (view_.header->workers_asleep.load(std::memory_order_relaxed) != 0 &&
            polling.load(std::memory_order_relaxed) == static_cast<std::uint32_t>(layout::WorkerPolling::no))
            polling.store(static_cast<std::uint32_t>(layout::WorkerPolling::soon), std::memory_order_relaxed);
    }

    /// This worker leaves to run a call, and has not polled since before the fence in claim(). If all other workers are
    /// awake, there is nothing to do. Otherwise callers must wake a worker from now on, and this worker wakes one for calls
    /// whose callers still relied on it.
    void leave_with_call(bool was_polling) {
        auto& header = *view_.header;
        if (header.workers_asleep.load(std::memory_order_relaxed) == 0) return; // after the fence in claim()
        if (was_polling) announce(layout::WorkerPolling::no);
        if (!any_submitted()) return;
        header.wake_count.fetch_add(1, std::memory_order_seq_cst);
        A::futex_wake(header.wake_count, 1);
    }

    BasicCallView<A> view_;
    std::size_t words_per_slot_;
    /// This process's private state of a slot, for the worker that is in it.
    struct Slot {
        bool has_overflow = false; // its buffer has memory
        std::unique_ptr<std::uint64_t[]> long_arguments;
    };

    std::unique_ptr<std::uint64_t[]> copies_;                      // takes no memory before it is used
    std::vector<typename A::template Atomic<std::uint32_t>> busy_; // 1 = a worker is in the slot
    std::vector<Slot> slots_;
    typename A::template Atomic<std::uint32_t> has_poller_{0}, waits_ended_{0};
};

} // namespace tandem::shm
