// SPDX-License-Identifier: Apache-2.0
// More callers than slots.
#include "call_fixture.hpp"

#include "shm/call/slot_turns.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// All slots are in use, by calls that no worker has taken yet.
struct FullQueue : CallPair {
    FullQueue() : CallPair({.slots = 2, .max_bytes = 64}) {
        for (int i = 0; i < 2; ++i) callers.push_back(call_aside(client, 60s));
        REQUIRE(eventually([&] { return client.counters().calls == 2; }));
    }
    ~FullQueue() {
        server.shut_down();
        for (auto& caller : callers) caller.wait();
    }
    std::vector<std::future<CallStatus>> callers;
};

} // namespace

TEST_CASE("a call that finds no slot until its deadline is refused and has not run") {
    FullQueue calls;
    const Reply refused = calls.client.call({}, 20ms);
    CHECK(refused.status == CallStatus::overload);
    CHECK(refused.text() == "none of the 2 calls under way ended before the deadline");
    CHECK(calls.client.counters().overloads == 1);
    CHECK(calls.client.counters().calls == 2);
}

TEST_CASE("callers without a slot wait for one, and all of their calls succeed") {
    constexpr int count = 64;
    FullQueue calls;
    for (int i = 0; i < count; ++i) calls.callers.push_back(call_aside(calls.client, 60s));
    {
        Workers workers(calls.server, 1, echo);
        for (auto& caller : calls.callers) CHECK(caller.get() == CallStatus::ok);
    }
    calls.callers.clear();
    CHECK(calls.client.counters().calls == count + 2);
    CHECK(calls.client.counters().overloads == 0);
    CHECK(calls.client.counters().in_use == 0);
}

TEST_CASE(
    "a caller that waits for a slot gets one that a call given up earlier frees when its worker is done") {
    CallPair calls({.slots = 1, .max_bytes = 64});
    auto late = call_aside(calls.client, 20ms);
    auto running = calls.server.take(20s);
    REQUIRE(running);
    CHECK(late.get() == CallStatus::timeout);
    auto waiting = call_aside(calls.client, 60s);
    running->reply(CallStatus::ok);
    Workers workers(calls.server, 1, echo);
    CHECK(waiting.get() == CallStatus::ok);
}

TEST_CASE("callers that wait for a slot return when either end of the queue is shut down") {
    FullQueue calls;
    auto waiting = call_aside(calls.client, 300s);
    SECTION("the calling end") { calls.client.shut_down(); }
    SECTION("the serving end") { calls.server.shut_down(); }
    CHECK(waiting.get() == CallStatus::shut_down);
}

TEST_CASE("a slot is the turn of the caller that has waited longest, and a caller that leaves passes it on") {
    SlotTurns turns;
    CHECK_FALSE(turns.any());
    auto first = std::make_optional<SlotTurns::Turn>(turns);
    auto second = std::make_optional<SlotTurns::Turn>(turns);
    SlotTurns::Turn third(turns);
    CHECK((first->has_come() && !second->has_come() && !third.has_come()));
    CHECK_FALSE(third.wait(0ns));
    second.reset(); // its deadline has passed
    CHECK((first->has_come() && !third.has_come()));
    first.reset();
    CHECK(third.has_come());
    auto woken = std::async(std::launch::async, [&] { return third.wait(60s); });
    while (woken.wait_for(1ms) != std::future_status::ready) turns.wake_first();
    CHECK(woken.get());
    CHECK(turns.any());
}
