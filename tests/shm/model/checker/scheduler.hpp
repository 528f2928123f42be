// SPDX-License-Identifier: Apache-2.0
// The second half of Execution: which thread runs next.
#pragma once
#include "tests/shm/model/checker/execution.hpp"

#include <exception>

namespace tandem::shm::model {

inline void Execution::run_body(std::size_t number) {
    try {
        threads_[number].body();
    } catch (const Ended&) {
    } catch (const std::exception& unexpected) {
        fail(threads_[number].name + ": exception: " + unexpected.what());
    }
    threads_[number].state = State::ended;
    threads_[number].finished = true;
    if (ending_ || starting_ || (turn_ = pick()) == 0)
        fibers_[number - 1]->switch_to(main_);
    else
        fibers_[number - 1]->switch_to(*fibers_[turn_ - 1]);
}

/// Lets every thread that has not come to its end leave its functions, so that nothing leaks.
inline void Execution::end_threads() {
    ending_ = true;
    for (turn_ = 1; turn_ <= count_; ++turn_)
        if (!threads_[turn_].finished) main_.switch_to(*fibers_[turn_ - 1]);
    turn_ = 0;
}

/// An execution that stops early has still found what its threads were about to do.
inline void Execution::look_at_what_never_ran() {
    if (choices_.random() || !settings_.reduced || failed()) return;
    for (std::size_t i = 1; i <= count_; ++i)
        if (!threads_[i].finished) reduction_.turn_round(choices_, i, threads_[i].next);
}

inline bool Execution::ready(const Thread& thread) const {
    if (thread.state == State::runs) return true;
    if (thread.state == State::sleeps) return thread.woken;
    if (thread.state == State::ended) return false;
    for (const Look& look : thread.looks)
        if (memory_.newest(look.word) > look.index) return true;
    return false;
}

/// The thread that runs next; 0: the execution is over.
inline std::size_t Execution::pick() {
    if (failed()) return 0;
    if (++steps_ > settings_.step_limit) {
        fail("no end after " + std::to_string(settings_.step_limit) + " steps");
        return 0;
    }
    Threads can = 0, may_expire = 0;
    std::array<Operation, max_threads> next{};
    for (std::size_t i = 1; i <= count_; ++i) {
        const Thread& thread = threads_[i];
        next[i] = thread.next;
        if (ready(thread))
            can |= 1U << i;
        else if (thread.lapses != 0 && (thread.state == State::paused ||
                                        (thread.state == State::sleeps && thread.deadline < never)))
            may_expire |= 1U << i;
    }
    if (can == 0 && may_expire == 0) return pass_time();
    Sleep sleep = settings_.reduced && reduction_.any() && !choices_.random()
                      ? reduction_.sleep_after(choices_.node(reduction_.last_node()), next)
                      : Sleep{};
    for (std::size_t i = 1; i <= count_; ++i) // a change has made another step of it
        if (threads_[i].state == State::paused && (can >> i & 1U) != 0) sleep[i] = awake;
    const auto chosen = choices_.thread(can, may_expire, turn_, sleep);
    if (!chosen) {
        redundant_ = true;
        return 0;
    }
    node_ = choices_.here() - 1;
    if (!settings_.reduced) choices_.node(node_).todo = can | may_expire;
    return *chosen;
}

/// No thread can run: the clock advances to the time at which one can. Returns 0 if no thread waits for the
/// clock.
inline std::size_t Execution::pass_time() {
    std::size_t first = 0;
    for (std::size_t i = 1; i <= count_; ++i) {
        const Thread& thread = threads_[i];
        if (thread.state == State::paused) {
            first = i;
            break;
        }
        const bool waits = thread.state == State::sleeps && thread.deadline < never;
        if (waits && (first == 0 || thread.deadline < threads_[first].deadline)) first = i;
    }
    if (first == 0) {
        std::string asleep_for_ever;
        for (std::size_t i = 1; i <= count_; ++i)
            if (threads_[i].state == State::sleeps) asleep_for_ever += " " + threads_[i].name;
        if (!asleep_for_ever.empty() && !settings_.ends_in_sleep)
            fail("asleep, and nobody is left to wake:" + asleep_for_ever);
        return 0;
    }
    if (++idle_ > 1000) {
        fail("nothing happens any more but time, and " + threads_[first].name + " still waits");
        return 0;
    }
    Thread& thread = threads_[first];
    if (thread.state == State::paused) {
        for (const auto& other : threads_)
            thread.observer.time = std::max(thread.observer.time, other.observer.time);
    }
    reduction_.after_all(first);
    choices_.thread(1U << first, 0, first, Sleep{});
    node_ = choices_.here() - 1;
    return first;
}

/// Gives the turn to the thread that pick() selects. Returns when this thread has the turn again.
inline void Execution::hand_on() {
    const std::size_t mine = turn_;
    const std::size_t next = starting_ ? 0 : pick();
    if (next != mine) {
        turn_ = next;
        fibers_[mine - 1]->switch_to(next == 0 ? main_ : *fibers_[next - 1]);
    }
    if (ending_) throw Ended{};
}

/// The start of every step: announces the step, and waits for the turn.
inline void Execution::await_turn(Operation operation, bool leaves_a_trace) {
    Thread& thread = me();
    const bool dies = thread.mortal && leaves_a_trace && !somebody_died_ && choices_.value(2, 24) == 1;
    if (dies) {
        operation = {};
        operation.kind = Kind::end;
        operation.location = life_of(thread.group);
        operation.group = thread.group;
    }
    thread.next = operation;
    hand_on();
    ++thread.observer.now.clock[turn_];
    if (explores()) reduction_.turn_round(choices_, turn_, operation);
    if (dies) die();
}

inline void Execution::die() {
    const std::uint8_t group = me().group;
    somebody_died_ = true;
    if (traced_) trace_.push_back(me().name + " is killed");
    done(me().next, 0, 0, false);
    for (std::size_t i = 1; i <= count_; ++i)
        if (threads_[i].group == group && !threads_[i].finished) {
            threads_[i].state = State::ended;
            threads_[i].dead = true;
        }
    hand_on();
}

inline bool Execution::lives(std::size_t thread) {
    Thread& other = threads_[thread];
    if (!in_thread() || over()) return !other.dead;
    Operation operation;
    operation.kind = Kind::load;
    operation.order = Order::seq_cst;
    operation.location = life_of(other.group);
    await_turn(operation, false);
    done(operation, 0, 0, false);
    if (other.dead) me().observer.now.join(other.observer.now, memory_.used());
    if (traced_)
        trace_.push_back(me().name + (other.dead ? " sees the death of " : " sees alive ") + other.name);
    return !other.dead;
}

inline void Execution::done(Operation operation, Index stored, Index read, bool open) {
    if (choices_.random()) return;
    reduction_.done({static_cast<std::uint8_t>(turn_), operation, node_, ++me().steps, stored, open}, read);
}

} // namespace tandem::shm::model
