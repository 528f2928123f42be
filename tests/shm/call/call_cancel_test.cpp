// SPDX-License-Identifier: Apache-2.0
#include "call_fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

TEST_CASE("a call can be begun and waited for later") {
    CallPair calls;
    auto one = calls.client.begin(1, bytes_of("one"), 20s);
    auto two = calls.client.begin(2, bytes_of("two"), 20s);
    CHECK_FALSE(one.ready());
    {
        Workers workers(calls.server, 1, echo);
        CHECK(two.wait().text() == "two");
        CHECK(one.wait().text() == "one");
    }
    CHECK(one.wait().status == CallStatus::cancelled); // there is nothing left to wait for
    CHECK(calls.client.counters().in_use == 0);
}

TEST_CASE("a call that cannot begin says so when it is waited for") {
    CallPair calls({.slots = 1, .max_bytes = 8});
    auto first = calls.client.begin(0, {}, 20s);
    auto second = calls.client.begin(0, {}, 20s);
    CHECK(second.ready());
    CHECK(second.wait().status == CallStatus::overload);
    auto third = calls.client.begin(0, std::vector<std::byte>(9), 20s);
    const Reply refused = third.wait();
    CHECK(refused.status == CallStatus::bad_arguments);
    CHECK_THAT(refused.text(), Catch::Matchers::Contains("9 bytes"));
    calls.server.shut_down();
    CHECK(first.wait().status == CallStatus::shut_down);
    CHECK(calls.client.begin(0, {}, 20s).wait().status == CallStatus::shut_down);
}

TEST_CASE("a call cancelled before a worker takes it never runs") {
    CallPair calls;
    auto call = calls.client.begin(1, {}, 300s);
    call.cancel();
    CHECK(call.ready());
    CHECK_FALSE(calls.server.take(0ns));
    CHECK(call.wait().status == CallStatus::cancelled);
    CHECK(calls.client.counters().in_use == 0);
    CHECK(calls.client.counters().cancels == 1);
    CHECK(calls.client.counters().taken == 0);
}

TEST_CASE("the worker of a running call sees that it was cancelled") {
    CallPair calls({.slots = 2, .max_bytes = 64});
    auto call = calls.client.begin(1, {}, 300s);
    auto running = calls.server.take(20s);
    REQUIRE(running);
    CHECK_FALSE(running->cancelled());
    call.cancel();
    CHECK(running->cancelled());
    CHECK(call.wait().status == CallStatus::cancelled);
    running->reply(CallStatus::ok);
    CHECK(running->cancelled()); // nobody waits for an answered call
    CHECK(calls.client.counters().in_use == 0);
}

TEST_CASE("another thread cancels a waiting call by its token") {
    const auto mode = GENERATE(WaitMode::spin, WaitMode::spin_then_futex, WaitMode::futex);
    CallPair calls({.slots = 2, .max_bytes = 64}, {.mode = mode});
    const bool taken = GENERATE(false, true);
    auto call = calls.client.begin(1, {}, 300s);
    auto running = taken ? calls.server.take(20s) : std::nullopt;
    const CancelToken token = call.token();
    std::thread other([&] {
        std::this_thread::sleep_for(2ms);
        token.cancel();
    });
    CHECK(call.wait().status == CallStatus::cancelled);
    other.join();
    running.reset();
    CHECK(calls.client.counters().in_use == 0);
}

TEST_CASE("a token does nothing after the end of its call") {
    CallPair calls({.slots = 1, .max_bytes = 64});
    auto first = calls.client.begin(1, bytes_of("first"), 300s);
    const CancelToken stale = first.token();
    calls.server.take(20s)->reply(CallStatus::ok, std::string("done"));
    CHECK(first.wait().text() == "done");
    stale.cancel();
    auto second = calls.client.begin(2, bytes_of("second"), 300s);
    stale.cancel();
    auto running = calls.server.take(20s);
    REQUIRE(running);
    stale.cancel();
    CHECK_FALSE(running->cancelled());
    running->reply(CallStatus::ok, running->arguments());
    CHECK(second.wait().text() == "second");
    CancelToken().cancel();
}

TEST_CASE("a pending call that is dropped is cancelled") {
    CallPair calls({.slots = 1, .max_bytes = 64});
    for (int i = 0; i < 3; ++i) calls.client.begin(1, {}, 300s);
    CHECK(calls.client.counters().in_use == 0);
    CHECK_FALSE(calls.server.take(0ns));
    {
        auto answered = calls.client.begin(1, {}, 300s);
        calls.server.take(20s)->reply(CallStatus::ok);
    }
    CHECK(calls.client.counters().cancels == 3);
    auto moved_from = calls.client.begin(1, {}, 300s);
    auto call = std::move(moved_from);
    calls.server.take(20s)->reply(CallStatus::ok);
    CHECK(call.wait().status == CallStatus::ok);
}

TEST_CASE("of calls cancelled at any moment none runs twice and all slots come back") {
    const std::size_t rounds = stress(2000), callers = GENERATE(1U, 3U);
    CallPair calls({.slots = 4, .max_bytes = 64});
    std::vector<std::atomic<std::uint8_t>> runs(callers * rounds);
    std::atomic<std::size_t> wrong{0}, cancelled{0};
    {
        Workers workers(calls.server, 2, [&](IncomingCall& call) {
            ++runs[call.operation()];
            for (std::uint32_t pause = 0; pause < call.operation() % 97; ++pause) _mm_pause();
            echo(call);
        });
        std::vector<std::thread> threads;
        for (std::size_t caller = 0; caller < callers; ++caller)
            threads.emplace_back([&, caller] {
                for (std::size_t i = 0; i < rounds; ++i) {
                    const auto id = static_cast<std::uint32_t>(caller * rounds + i);
                    const std::string text = std::to_string(id);
                    auto call = calls.client.begin(id, bytes_of(text), 60s);
                    // From at once to long after the reply.
                    for (std::size_t pause = 0; pause < i % 41; ++pause) _mm_pause();
                    if (i % 4 != 0) call.cancel();
                    const Reply reply = call.wait();
                    if (reply.status == CallStatus::ok && (reply.text() != text || runs[id] != 1)) ++wrong;
                    if (reply.status == CallStatus::cancelled)
                        ++cancelled;
                    else if (reply.status != CallStatus::ok && reply.status != CallStatus::overload)
                        ++wrong;
                }
            });
        for (auto& thread : threads) thread.join();
    }
    CHECK(wrong == 0);
    CHECK(std::none_of(runs.begin(), runs.end(), [](const auto& count) { return count > 1; }));
    const auto counters = calls.client.counters();
    CHECK(counters.in_use == 0);
    CHECK(counters.taken == counters.answered);
    CHECK(counters.cancels == cancelled);
}
