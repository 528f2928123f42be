// SPDX-License-Identifier: Apache-2.0
// A call queue in the model: the actions of a scenario's callers and workers, and what must hold at the end. The waiting loops
// follow CallClient::State::await_reply and IncomingCall::State::take, which are bound to a Mapping; everything that touches
// shared memory is the code that ships.
#pragma once
#include "shm/call/call_caller.hpp"
#include "shm/call/call_worker.hpp"
#include "tests/shm/model/checker/model.hpp"

#include <map>

namespace tandem::shm::model {

class CallWorld {
  public:
    using A = ModelAtomics;
    static constexpr std::uint64_t never = ~std::uint64_t{0};
    static constexpr std::uint64_t second = 1'000'000'000;
    enum class End { answered, timeout, overload, closed, peer_died };
    using Ends = std::map<std::uint32_t, End>; ///< by the number of the call

    explicit CallWorld(Execution& execution, std::uint32_t slots = 2)
        : execution_(execution),
          slots_(std::make_unique<layout::BasicCallSlot<A>[]>(slots)), view_{.header = &header_,
                                                                             .slots = slots_.get(),
                                                                             .slot_count = slots,
                                                                             .max_bytes = sizeof(Message),
                                                                             .short_bytes = sizeof(Message),
                                                                             .loans = {}},
          caller(view_), worker(view_) {}

    /// The deadline of a call that is never late: long after all that a scenario takes, and of this call
    /// only.
    static constexpr std::uint64_t far(std::uint32_t id) { return id * 1000 * second; }

    /// Calls and waits for the end.
    End call(std::uint32_t id, std::uint64_t timeout, std::uint32_t prefer = 0,
             std::size_t worker_thread = 0) {
        CallTicket ticket;
        const End begun = begin(id, timeout, prefer, true, ticket);
        return begun == End::answered ? wait(id, ticket, worker_thread) : begun;
    }

    End begin(std::uint32_t id, std::uint64_t timeout, std::uint32_t prefer, bool waits, CallTicket& ticket) {
        return begin(caller, id, timeout, prefer, waits, ticket);
    }
    End begin(CallCaller<A>& with, std::uint32_t id, std::uint64_t timeout, std::uint32_t prefer, bool waits,
              CallTicket& ticket) {
        const Message message{id, ~std::uint64_t{id}};
        const CallStart start = with.begin(&message, sizeof message, timeout, prefer, waits, ticket);
        if (start != CallStart::ok) return start == CallStart::overload ? End::overload : End::closed;
        ++begun_;
        return End::answered;
    }

    /// A caller whose deadline is far away sleeps until it is woken: a wake-up that is lost is a failure.
    End wait(std::uint32_t id, CallTicket& ticket, std::size_t worker_thread = 0, bool polls = false) {
        const bool patient = ticket.deadline_ns > 500 * second && worker_thread == 0;
        bool over = caller.replied(ticket);
        while (!over) {
            if (worker_thread != 0 && !execution_.lives(worker_thread)) {
                caller.forget(ticket);
                return End::peer_died;
            }
            const std::uint64_t now = A::now();
            if (now >= ticket.deadline_ns)
                return caller.withdraw(ticket) ? End::timeout : collect(id, ticket);
            const std::uint64_t until = patient ? never : ticket.deadline_ns;
            over = polls ? caller.spin(ticket, until) : caller.sleep(ticket, until);
        }
        return collect(id, ticket);
    }

    /// The progress that the worker reports for a call.
    static double progress_of(std::uint64_t id) { return static_cast<double>(id) / 8; }
    /// The caller sees either this call's progress or none, and always some once there is a reply.
    void expect_progress(std::uint32_t id, const CallTicket& ticket) {
        const bool over = caller.replied(ticket);
        const auto share = caller.progress(ticket);
        execution_.require(share ? *share == progress_of(id) : !over, "the progress is that of the call");
    }

    std::optional<TakenCall> take(bool& polling) {
        TakenCall taken;
        return worker.take(polling, taken) ? std::optional(taken) : std::nullopt;
    }

    /// Serves until end_all_waits(). `tells`: reports the progress of calls. `polls`: may be the worker that
    /// polls.
    void serve(std::uint32_t calls, bool polls = false, bool tells = false) {
        int fruitless = 0;
        for (bool polling = false; calls > 0;) {
            if (const auto taken = take(polling)) {
                if (tells) worker.set_progress(*taken, progress_of(id_of(*taken)));
                answer(*taken);
                --calls;
                fruitless = 0;
                continue;
            }
            if (worker.waits_ended()) break;
            // If another worker is about to take the call that this worker has found, this worker searches again until the call
            // is taken.
            if (++fruitless > 2) A::pause();
            polling = polling || (polls && worker.try_become_poller());
            if (polling && worker.spin(A::now() + 50'000)) continue;
            if (polling) worker.stop_polling();
            polling = false;
            worker.sleep(never);
        }
    }

    /// Like a worker that never waits: looks for a call this number of times, and answers it.
    void look(int times) {
        bool polling = false;
        for (int i = 0; i < times; ++i)
            if (const auto taken = take(polling)) answer(*taken);
    }

    static std::uint64_t id_of(const TakenCall& taken) {
        Message message{};
        std::memcpy(&message, taken.arguments, sizeof message);
        return message.id;
    }

    void answer(const TakenCall& taken) {
        Message message{};
        execution_.require(taken.valid && taken.bytes() == sizeof message, "a taken call has its length");
        std::memcpy(&message, taken.arguments, sizeof message);
        execution_.require(message.check == ~message.id, "the arguments are of one call");
        const std::uint64_t expected = far(static_cast<std::uint32_t>(message.id)), found = taken.deadline_ns;
        execution_.require((found > expected && found < expected + 500 * second) ||
                               (found > 1000 && found < 500 * second),
                           "the deadline is that of the call");
        execution_.require(++runs[static_cast<std::uint32_t>(message.id)] == 1, "no call runs twice");
        message = {message.id + 1000, ~(message.id + 1000)};
        worker.answer(taken, CallStatus::ok, &message, sizeof message);
    }

    /// The frame of most scenarios: runs the threads; then every call has ended in one of the ways allowed,
    /// and the queue is sound.
    void run(const Ends& ends, std::initializer_list<End> allowed) {
        execution_.run();
        expect(ends, allowed);
        check(ends);
    }
    void expect(const Ends& ends, std::initializer_list<End> allowed) {
        for (const auto& [id, end] : ends)
            execution_.require(std::find(allowed.begin(), allowed.end(), end) != allowed.end(),
                               "call " + std::to_string(id) + " ends as it may, not as " +
                                   std::to_string(static_cast<int>(end)));
    }

    /// Checks at the end that every answered call has run, and that every slot is free again.
    void check(const Ends& ends, bool killed = false) {
        for (const auto& [id, end] : ends) {
            if (end == End::answered) execution_.require(runs[id] == 1, "an answered call has run");
            if (end == End::overload || end == End::closed)
                execution_.require(runs[id] == 0, "a refused call has not run");
        }
        std::uint64_t calls = 0, answered = 0, ran = 0;
        for (std::uint32_t i = 0; i < view_.slot_count; ++i) {
            calls += slots_[i].request.calls.load(Order::relaxed);
            answered += slots_[i].work.answered.load(Order::relaxed);
        }
        for (const auto& [id, times] : runs) ran += static_cast<std::uint64_t>(times);
        execution_.require((calls == begun_ && answered == ran) || killed, "the counters are right");
        for (std::uint32_t i = 0; i < view_.slot_count; ++i) {
            CallTicket ticket;
            execution_.require(begin(900 + i, second, 0, true, ticket) == End::answered, "no slot is lost");
        }
    }

  private:
    struct Message {
        std::uint64_t id, check;
    };

    End collect(std::uint32_t id, const CallTicket& ticket) {
        const std::uint64_t word = caller.reply(ticket);
        Message message{};
        execution_.require(word != 0 && length_of(word) == sizeof message, "a reply has its length");
        caller.copy_results(ticket, &message, sizeof message);
        execution_.require(message.id == id + 1000 && message.check == ~message.id,
                           "a reply is that of its call");
        caller.finish(ticket);
        return End::answered;
    }

    Execution& execution_;
    layout::BasicCallQueueHeader<A> header_{};
    std::unique_ptr<layout::BasicCallSlot<A>[]> slots_;
    BasicCallView<A> view_;
    std::uint64_t begun_ = 0;

  public:
    const BasicCallView<A>& view() const { return view_; }

    CallCaller<A> caller;
    CallWorker<A> worker;
    std::map<std::uint32_t, int> runs;
};

} // namespace tandem::shm::model
