// SPDX-License-Identifier: Apache-2.0
// Calls that are cancelled while they wait or run, and calls that report their progress.
#include "call_fixture.hpp"

#include "shm/call/call_words.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

struct Wishes {
    std::atomic<bool> cancelled{false};
    std::atomic<double> progress{-1};
    std::uint64_t max_ns = 0;
};
thread_local Wishes* wishes_of_thread = nullptr;

CallControl find_control() {
    if (!wishes_of_thread) return {};
    return {&wishes_of_thread->cancelled, &wishes_of_thread->progress, wishes_of_thread->max_ns};
}

/// Like CallPair, with a client whose calls can be cancelled.
struct ControlledPair : Pair {
    explicit ControlledPair(std::uint32_t slots = 2)
        : client(first->add_call_queue("c", {.slots = slots, .max_bytes = 64}), {}, find_control),
          server((first->publish(), *second->find_call_queue(Side::first, "c"))) {}
    std::future<Reply> call(Wishes& wishes, std::chrono::nanoseconds timeout) {
        return std::async(std::launch::async, [this, &wishes, timeout] {
            wishes_of_thread = &wishes;
            return client.call(bytes_of("x"), timeout);
        });
    }
    CallClient client;
    CallServer server;
};

} // namespace

TEST_CASE("a caller that cancels gets its error while the worker still runs and the worker is notified") {
    ControlledPair calls(1);
    Wishes wishes;
    auto caller = calls.call(wishes, 300s);
    auto running = calls.server.take(20s);
    REQUIRE(running);
    CHECK_FALSE(running->cancelled());
    wishes.cancelled = true;
    CHECK(caller.get().status == CallStatus::cancelled);
    CHECK(running->cancelled());
    CHECK(calls.client.counters().cancels == 1);
    CHECK(calls.client.call({}, 5ms).status == CallStatus::overload); // the worker is still in the slot
    running->reply(CallStatus::ok, std::string("late"));
    CHECK(running->cancelled());
    Workers workers(calls.server, 1, echo);
    CHECK(calls.client.call(bytes_of("y"), 20s).text() == "y");
    CHECK(calls.client.counters().in_use == 0);
}

TEST_CASE("a call that is cancelled before a worker takes it never runs") {
    ControlledPair calls;
    Wishes wishes;
    wishes.cancelled = true;
    CHECK(calls.call(wishes, 300s).get().status == CallStatus::cancelled);
    CHECK_FALSE(calls.server.take(0ns));
    CHECK(calls.client.counters().taken == 0);
}

TEST_CASE("a worker is notified when the deadline of its caller has passed") {
    ControlledPair calls;
    Wishes wishes;
    wishes.max_ns = 1;
    auto caller = calls.call(wishes, 300s);
    const auto running = calls.server.take(1s);
    CHECK(caller.get().status == CallStatus::timeout);
    if (running) CHECK(running->cancelled());
}

TEST_CASE("a call may be allowed to run longer than the time in which it must start") {
    ControlledPair calls;
    Wishes wishes;
    wishes.max_ns = 300'000'000'000;
    auto caller = calls.call(wishes, 2s);
    auto running = calls.server.take(20s);
    if (!running) return; // the machine was so slow that it did not begin in time
    std::this_thread::sleep_for(2500ms);
    CHECK_FALSE(running->cancelled());
    running->reply(CallStatus::ok, std::string("done"));
    CHECK(caller.get().text() == "done");
}

TEST_CASE("a worker is notified when its queue is shut down") {
    ControlledPair calls;
    Wishes wishes;
    auto caller = calls.call(wishes, 300s);
    auto running = calls.server.take(20s);
    REQUIRE(running);
    calls.server.shut_down();
    CHECK(running->cancelled());
    running->reply(CallStatus::ok);
    CHECK(caller.get().status == CallStatus::ok);
}

TEST_CASE("a caller learns the progress of its call, and nothing about the earlier call in the same slot") {
    ControlledPair calls(1);
    for (int round = 0; round < 3; ++round) {
        Wishes wishes;
        auto caller = calls.call(wishes, 300s);
        auto running = calls.server.take(20s);
        REQUIRE(running);
        std::this_thread::sleep_for(20ms); // looks at the word meanwhile
        CHECK(wishes.progress == -1);
        for (const double share : {0.0, 0.25, 0.5}) {
            running->set_progress(share);
            CHECK(eventually([&] { return wishes.progress == share; }));
        }
        running->reply(CallStatus::ok);
        running->set_progress(0.75); // too late: does nothing
        CHECK(caller.get().status == CallStatus::ok);
        CHECK(wishes.progress == 0.5);
    }
}

TEST_CASE("progress is from 0 to 1 whatever was reported and whatever the word is") {
    CHECK(share_of(progress_word(1, -1)) == 0);
    CHECK(share_of(progress_word(1, 7)) == 1);
    CHECK(share_of(progress_word(1, std::numeric_limits<double>::quiet_NaN())) == 0);
    CHECK(share_of(progress_word(1, 1.0 / 3)) == Approx(1.0 / 3));
    CHECK(share_of(~std::uint64_t{0}) == 1);
    CHECK(sequence_of(progress_word(77, 1)) == 77);
}

TEST_CASE("cancelling a call that has ended changes nothing") {
    ControlledPair calls;
    Workers workers(calls.server, 1, echo);
    Wishes wishes;
    CHECK(calls.call(wishes, 20s).get().text() == "x");
    wishes.cancelled = true;
    CHECK(calls.client.counters().cancels == 0);
    CHECK(calls.client.call(bytes_of("y"), 20s).text() == "y");
}
