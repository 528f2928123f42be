// SPDX-License-Identifier: Apache-2.0
// What each access does when its turn has come: the first half of Execution.
#pragma once
#include "tests/shm/model/checker/execution.hpp"

namespace tandem::shm::model {

/// True for a destructor that runs because the execution is over: its accesses do nothing.
inline bool Execution::over() {
    if (!ending_) return false;
    if (!in_thread() || std::uncaught_exceptions() > 0) return true;
    throw Ended{};
}

inline void Execution::trace(const Site& at, const char* what, const std::string& rest) {
    if (traced_)
        trace_.push_back((in_thread() ? me().name : "main") + " " + name_of(at) + " " + what + " " + rest);
}

inline void Execution::check_race(std::uint32_t word, bool writes, bool plain, const Site& at) {
    if (memory_.note(me().observer, turn_, word, writes, plain)) return;
    fail("data race: " + me().name + " " + (writes ? "writes" : "reads") + " word " + std::to_string(word) +
         " at " + name_of(at));
    throw Ended{};
}

/// Reads one of the stores that may be read.
inline std::uint64_t Execution::look(std::uint32_t word, Order order, Index& read, bool& open) {
    Observer& who = me().observer;
    const Index newest = memory_.newest(word);
    open = sequential(order) && memory_.at(word).sequential < newest;
    std::size_t oldest = memory_.oldest_readable(who, word, order);
    if (!choices_.random()) { // see Sleep
        const Index floor = choices_.node(node_).sleep[turn_];
        if (floor != asleep) oldest = std::max<std::size_t>(oldest, floor);
    }
    // Stores become visible eventually: no thread reads the same old store forever.
    Repeat& repeat = me().repeats[word];
    const std::size_t allowed = oldest;
    if (me().pauses >= settings_.max_stale_reads || me().hurry != 0) oldest = newest;
    if (repeat.index >= oldest && repeat.index < newest && repeat.count >= settings_.max_stale_reads)
        oldest = repeat.index + 1U;
    if (oldest != allowed && explores())
        reduction_.turn_round(choices_, turn_, {Kind::load, order, word}, true);
    read = static_cast<Index>(newest - choices_.value(static_cast<std::uint32_t>(newest - oldest + 1)));
    repeat = {read, read == newest ? 0 : read == repeat.index ? repeat.count + 1 : 1};
    me().looks.push_back({word, read});
    return memory_.read(who, word, read, order);
}

inline std::uint64_t Execution::load(std::uint32_t word, Order order, const Site& at) {
    if (log_ != nullptr) log_->note(at, Access::load, order);
    order = weakened(at, Damage::weaker_order, order);
    if (!in_thread()) return memory_.read(me().observer, word, memory_.newest(word), order);
    if (over()) return 0;
    const Operation operation{Kind::load, order, word};
    await_turn(operation, false);
    check_race(word, false, false, at);
    Index read = 0;
    bool open = false;
    const std::uint64_t value = look(word, order, read, open);
    done(operation, 0, read, open);
    if (traced_)
        trace(at, "load",
              std::to_string(word) + " = " + std::to_string(value) + " " + name_of(order) + " store " +
                  std::to_string(read) + " of " + std::to_string(memory_.newest(word)));
    return value;
}

inline void Execution::store(std::uint32_t word, std::uint64_t value, Order order, const Site& at) {
    if (log_ != nullptr) log_->note(at, Access::store, order);
    order = weakened(at, Damage::weaker_order, order);
    if (damaged(at, Damage::no_store)) return;
    if (!in_thread()) return memory_.write(me().observer, word, value, order);
    if (over()) return;
    const Operation operation{Kind::store, order, word};
    await_turn(operation, true);
    check_race(word, true, false, at);
    me().pauses = 0;
    memory_.write(me().observer, word, value, order);
    done(operation, memory_.newest(word), 0, false);
    if (traced_)
        trace(at, "store", std::to_string(word) + " = " + std::to_string(value) + " " + name_of(order));
}

template <class Function>
std::uint64_t Execution::change(std::uint32_t word, Order order, const Site& at, Function&& function) {
    if (log_ != nullptr) log_->note(at, Access::change, order);
    order = weakened(at, Damage::weaker_order, order);
    const Operation operation{Kind::change, order, word};
    if (in_thread()) {
        if (over()) return 0;
        await_turn(operation, true);
        check_race(word, true, false, at);
        me().pauses = 0;
    }
    Observer& who = me().observer;
    const Index newest = memory_.newest(word);
    const std::uint64_t value = memory_.read(who, word, newest, order);
    const bool stores = !damaged(at, Damage::no_store);
    if (stores) memory_.write(who, word, function(value), order, newest);
    if (!in_thread()) return value;
    done(operation, stores ? memory_.newest(word) : Index{0}, newest, false);
    if (traced_)
        trace(at, "change", std::to_string(word) + " from " + std::to_string(value) + " " + name_of(order));
    return value;
}

inline bool Execution::compare(std::uint32_t word, std::uint64_t& expected, std::uint64_t value, Order order,
                               Order failure, const Site& at) {
    if (log_ != nullptr) log_->note(at, Access::compare, order, failure);
    order = weakened(at, Damage::weaker_order, order);
    failure = weakened(at, Damage::weaker_failure, failure);
    Operation operation{Kind::change, order, word};
    if (in_thread()) {
        if (over()) return false;
        await_turn(operation, true);
        check_race(word, true, false, at);
        me().pauses = 0;
    }
    Observer& who = me().observer;
    const Index newest = memory_.newest(word);
    const auto& stores = memory_.at(word).stores;
    const bool blind = damaged(at, Damage::no_comparison);
    // It may succeed on the newest store only, and fail on any that may be read and differs.
    std::vector<Index> readable;
    const bool may_succeed = blind || stores[newest].value == expected;
    if (may_succeed) readable.push_back(newest);
    const Index oldest = in_thread() ? memory_.oldest_readable(who, word, failure) : newest;
    for (int i = newest; !blind && i >= oldest; --i)
        if (stores[static_cast<Index>(i)].value != expected) readable.push_back(static_cast<Index>(i));
    const std::size_t chosen = in_thread() ? choices_.value(static_cast<std::uint32_t>(readable.size())) : 0;
    const bool success = may_succeed && chosen == 0;
    const Index read = readable[chosen];
    const bool open = memory_.at(word).sequential < newest;
    const std::uint64_t found = memory_.read(who, word, read, success ? order : failure);
    if (success)
        memory_.write(who, word, value, order, read);
    else
        expected = found;
    if (!in_thread()) return success;
    if (!success) operation = {Kind::load, failure, word};
    done(operation, success ? memory_.newest(word) : Index{0}, read, open);
    if (traced_)
        trace(at, success ? "exchange" : "exchange failed",
              std::to_string(word) + " from " + std::to_string(found) + " to " + std::to_string(value));
    return success;
}

/// Plain accesses are not separate steps. If they are ordered, their exact moment cannot be observed; if not, the race is found
/// in either order.
inline std::uint64_t Execution::take(std::uint32_t word, const Site& at) {
    if (in_thread()) {
        if (over()) return 0;
        ++me().observer.now.clock[turn_];
        check_race(word, false, true, at);
    }
    return memory_.read(me().observer, word, memory_.newest(word), Order::relaxed);
}

inline void Execution::put(std::uint32_t word, std::uint64_t value, const Site& at) {
    if (in_thread()) {
        if (over()) return;
        ++me().observer.now.clock[turn_];
        check_race(word, true, true, at);
    }
    memory_.write(me().observer, word, value, Order::relaxed);
}

/// The value that this thread has read last from a word must happen before every later store to it. A copy that is believed
/// must be like that: otherwise the processor or compiler may delay the load behind the store (load buffering, which the
/// executions themselves do not show).
inline void Execution::settle(std::uint32_t word, const Site& at) {
    if (!in_thread() || over()) return;
    if (memory_.settle(turn_, word, me().repeats[word].index)) return;
    fail("a store does not wait for what " + me().name + " has read of word " + std::to_string(word) +
         " before " + name_of(at));
    throw Ended{};
}

inline void Execution::fence(const Site& at) {
    if (log_ != nullptr) log_->note(at, Access::fence, Order::seq_cst);
    if (damaged(at, Damage::no_fence)) return;
    if (!in_thread() || over()) return;
    const Operation operation{Kind::fence, Order::seq_cst};
    await_turn(operation, false);
    memory_.fence(me().observer);
    done(operation, 0, 0, false);
    trace(at, "fence", "");
}

/// Goes on when something that was looked at since the last pause has changed, or when time is up: then the
/// next rounds go by without a change, until the thread looks at the clock.
inline void Execution::pause(const Site& at) {
    if (!in_thread() || over()) return;
    Thread& thread = me();
    ++thread.pauses;
    if (thread.hurry != 0) {
        --thread.hurry;
        thread.observer.time += idle_round;
        return;
    }
    thread.next = {};
    thread.state = State::paused;
    trace(at, "pause", "");
    hand_on();
    if (!ready(thread)) { // nothing has changed: time is up, as far as this thread is concerned
        if (thread.lapses != 0) --thread.lapses;
        thread.hurry = polling_rounds;
        thread.observer.time += idle_round;
    } else if (thread.lapses != 0 && explores()) { // and it may have been up before that change
        for (const Look& look : thread.looks)
            reduction_.turn_round(choices_, turn_, {Kind::load, Order::seq_cst, look.word});
    }
    thread.state = State::runs;
    thread.looks.clear();
    done(thread.next, 0, 0, false);
}

inline std::uint64_t Execution::now() {
    if (in_thread() && over()) return ~std::uint64_t{0} - 1;
    Thread& thread = me();
    ++thread.observer.time;
    thread.hurry = 0;
    if (in_thread() && thread.lapses != 0 && choices_.value(2, 8) == 1) {
        --thread.lapses;
        thread.observer.time += lapse;
        if (traced_) trace_.push_back(thread.name + " finds that time has passed");
    }
    return thread.observer.time;
}

/// Works like the kernel: a barrier, then the comparison and the enqueueing in one step. The barrier is modelled only for this
/// word, so code that relies on more fails here.
inline void Execution::sleep(std::uint32_t word, std::uint64_t expected, std::uint64_t deadline,
                             const Site& at) {
    if (!in_thread() || over()) return;
    Thread& thread = me();
    if (thread.observer.time >= deadline) return;
    const Operation operation{Kind::sleep, Order::seq_cst, word, queue_of(word)};
    await_turn(operation, true);
    Index read = 0;
    bool open = false;
    const std::uint64_t value = look(word, Order::seq_cst, read, open);
    done(operation, 0, read, open);
    trace(at, value == expected ? "falls asleep" : "does not sleep", "");
    if (value != expected) return;
    thread.state = State::sleeps;
    thread.woken = false;
    thread.deadline = deadline;
    thread.queue = queue_of(word);
    thread.pauses = 0;
    thread.next = {Kind::expire, Order::relaxed, no_location, thread.queue};
    hand_on();
    thread.state = State::runs;
    if (thread.woken) {
        reduction_.after_word(turn_, thread.queue);
    } else {
        if (explores()) reduction_.turn_round(choices_, turn_, thread.next);
        if (thread.lapses != 0) --thread.lapses;
        thread.observer.time = std::max(thread.observer.time, deadline);
        trace(at, "has slept to the deadline", "");
    }
    done(thread.next, 0, 0, false);
}

inline void Execution::wake(std::uint32_t word, int sleepers, const Site& at) {
    if (log_ != nullptr) log_->note(at, Access::wake, Order::seq_cst);
    if (damaged(at, Damage::no_wake)) return;
    if (!in_thread() || over()) return;
    const Operation operation{Kind::wake, Order::seq_cst, word, queue_of(word)};
    await_turn(operation, true);
    const bool open = memory_.at(word).sequential < memory_.newest(word);
    memory_.pass_on(me().observer, word);
    trace(at, "wakes", "");
    done(operation, 0, 0, open);
    for (std::size_t i = 1; i <= count_ && sleepers > 0; ++i) {
        Thread& thread = threads_[i];
        if (thread.state != State::sleeps || thread.woken || thread.queue != operation.queue) continue;
        if (thread.lapses != 0 && explores())
            reduction_.turn_round(choices_, i, thread.next); // its deadline may have come first
        thread.woken = true;
        thread.next = {};
        thread.observer.time = std::max(thread.observer.time, me().observer.time);
        --sleepers;
    }
}

} // namespace tandem::shm::model
