// SPDX-License-Identifier: Apache-2.0
#include "call_fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

TEST_CASE("of calls from eight threads to four workers none is lost or doubled") {
    const auto mode = GENERATE(WaitMode::spin_then_futex, WaitMode::futex);
    CallPair calls({.slots = 8, .max_bytes = 64}, {.mode = mode});
    const std::size_t callers = 8,
                      rounds = stress(6250); // 10^6 calls at TANDEM_STRESS=20, in two ways of waiting
    std::vector<std::atomic<std::uint8_t>> runs(callers * rounds);
    std::atomic<std::size_t> wrong{0};
    {
        Workers workers(calls.server, 4, [&](IncomingCall& call) {
            ++runs[call.operation()];
            echo(call);
        });
        std::vector<std::thread> threads;
        for (std::size_t caller = 0; caller < callers; ++caller)
            threads.emplace_back([&, caller] {
                std::vector<std::byte> results;
                for (std::size_t id = caller * rounds; id < (caller + 1) * rounds; ++id) {
                    const std::string text = std::to_string(id);
                    const auto status =
                        calls.client.call_into(static_cast<std::uint32_t>(id), bytes_of(text), 60s, results);
                    if (status != CallStatus::ok || text_of(results) != text) ++wrong;
                }
            });
        for (auto& thread : threads) thread.join();
    }
    CHECK(wrong == 0);
    CHECK(std::all_of(runs.begin(), runs.end(), [](const auto& count) { return count == 1; }));
    const auto counters = calls.client.counters();
    CHECK(counters.calls == callers * rounds);
    CHECK(counters.taken == callers * rounds);
    CHECK(counters.answered == callers * rounds);
    CHECK(counters.in_use == 0);
}

TEST_CASE("no call waits while a worker sleeps") {
    // Begun and not waited for, so that the callers' second look before they sleep does not help.
    const auto mode = GENERATE(WaitMode::spin_then_futex, WaitMode::futex);
    CallPair calls({.slots = 8, .max_bytes = 64}, {.mode = mode, .spin = 3us});
    std::atomic<std::size_t> ran{0}, late{0};
    {
        Workers workers(calls.server, 3, [&](IncomingCall& call) {
            ++ran;
            echo(call);
        });
        std::vector<std::thread> threads;
        for (int caller = 0; caller < 2; ++caller)
            threads.emplace_back([&] {
                for (std::size_t i = 0; i < stress(1500); ++i) {
                    auto call = calls.client.begin(0, {}, 120s);
                    if (!eventually([&] { return call.ready(); }, 60s)) ++late;
                    call.wait();
                    if (i % 7 == 0) std::this_thread::sleep_for(20us);
                }
            });
        for (auto& thread : threads) thread.join();
    }
    CHECK(late == 0);
    CHECK(ran == 2 * stress(1500));
}

TEST_CASE("a caller that only polls has a worker woken though another was expected back") {
    Pair pair;
    CallClient client(pair.first->add_call_queue("c", {.slots = 2, .max_bytes = 64}), {WaitMode::spin});
    pair.first->publish();
    CallServer server(*pair.second->find_call_queue(Side::first, "c"), {WaitMode::spin_then_futex, 10s});
    std::thread once([&] { // polls, answers, and does not come back
        if (auto call = server.take(20s)) echo(*call);
    });
    std::this_thread::sleep_for(20ms); // so that it is this one that polls, and the other one that sleeps
    Workers asleep(server, 1, echo);
    std::this_thread::sleep_for(20ms);
    CHECK(client.call(0, {}, 5s).status == CallStatus::ok);
    CHECK(client.call(0, {}, 5s).status == CallStatus::ok);
    server.interrupt();
    once.join();
}

TEST_CASE("calls to a server with a polling worker wake nobody") {
    CallPair calls({.slots = 4, .max_bytes = 64}, {.spin = 60s});
    Workers workers(calls.server, 3, echo);
    const std::size_t rounds = 3000;
    std::vector<std::byte> results;
    for (std::size_t i = 0; i < rounds; ++i)
        REQUIRE(calls.client.call_into(0, bytes_of("x"), 60s, results) == CallStatus::ok);
    const auto counters = calls.client.counters();
    CHECK(counters.caller_wakes == 0);
    CHECK(counters.worker_wakes < rounds / 100); // the first calls come while the others lie down
}
