// SPDX-License-Identifier: Apache-2.0
#include "call_fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

TEST_CASE("no call from eight threads to four workers is lost or duplicated") {
    const auto mode = GENERATE(WaitMode::spin_then_futex, WaitMode::futex);
    CallPair calls({.slots = 8, .max_bytes = 64}, {.mode = mode});
    const std::size_t callers = 8,
                      rounds = stress(6250); // 10^6 calls at TANDEM_STRESS=20, in two ways of waiting
    std::vector<std::atomic<std::uint8_t>> runs(callers * rounds);
    std::atomic<std::size_t> wrong{0};
    {
        Workers workers(calls.server, 4, [&](IncomingCall& call) {
            ++runs[number_of(call)];
            echo(call);
        });
        std::vector<std::thread> threads;
        for (std::size_t caller = 0; caller < callers; ++caller)
            threads.emplace_back([&, caller] {
                std::vector<std::byte> results;
                for (std::size_t id = caller * rounds; id < (caller + 1) * rounds; ++id) {
                    const std::string text = std::to_string(id);
                    const auto status = calls.client.call_into(bytes_of(text), 60s, results);
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
    // Callers that only poll, so that their second look before they sleep does not help.
    const auto mode = GENERATE(WaitMode::spin_then_futex, WaitMode::futex);
    Pair pair;
    CallClient client(pair.first->add_call_queue("c", {.slots = 8, .max_bytes = 64}), {WaitMode::spin});
    pair.first->publish();
    CallServer server(*pair.second->find_call_queue(Side::first, "c"), {.mode = mode, .spin = 3us});
    std::atomic<std::size_t> ran{0}, late{0};
    {
        Workers workers(server, 3, [&](IncomingCall& call) {
            ++ran;
            echo(call);
        });
        std::vector<std::thread> threads;
        for (int caller = 0; caller < 2; ++caller)
            threads.emplace_back([&] {
                for (std::size_t i = 0; i < stress(1500); ++i) {
                    if (client.call({}, 60s).status != CallStatus::ok) ++late;
                    if (i % 7 == 0) std::this_thread::sleep_for(20us);
                }
            });
        for (auto& thread : threads) thread.join();
    }
    CHECK(late == 0);
    CHECK(ran == 2 * stress(1500));
}

TEST_CASE("calls given up at any moment never run twice, and all slots become free again") {
    const std::size_t rounds = stress(2000), callers = GENERATE(1U, 3U);
    CallPair calls({.slots = 4, .max_bytes = 64});
    std::vector<std::atomic<std::uint8_t>> runs(callers * rounds);
    std::atomic<std::size_t> wrong{0}, timeouts{0};
    {
        Workers workers(calls.server, 2, [&](IncomingCall& call) {
            const std::size_t number = number_of(call);
            ++runs[number];
            for (std::size_t pause = 0; pause < number % 97; ++pause) Processor::pause();
            echo(call);
        });
        std::vector<std::thread> threads;
        for (std::size_t caller = 0; caller < callers; ++caller)
            threads.emplace_back([&, caller] {
                for (std::size_t i = 0; i < rounds; ++i) {
                    const std::size_t number = caller * rounds + i;
                    const std::string text = std::to_string(number);
                    // Deadlines from immediately to long after the reply.
                    const auto timeout =
                        i % 4 == 0 ? std::chrono::nanoseconds(60s) : std::chrono::nanoseconds(100 * (i % 83));
                    const Reply reply = calls.client.call(bytes_of(text), timeout);
                    if (reply.status == CallStatus::ok && (reply.text() != text || runs[number] != 1))
                        ++wrong;
                    if (reply.status == CallStatus::timeout)
                        ++timeouts;
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
    CHECK(counters.timeouts + counters.expired >= timeouts);
}

TEST_CASE("a caller that only polls wakes a worker even if another one is expected back") {
    Pair pair;
    CallClient client(pair.first->add_call_queue("c", {.slots = 2, .max_bytes = 64}), {WaitMode::spin});
    pair.first->publish();
    CallServer server(*pair.second->find_call_queue(Side::first, "c"), {WaitMode::spin_then_futex, 10s});
    std::thread once([&] { // polls, answers, and does not come back
        if (auto call = server.take(20s)) echo(*call);
    });
    std::this_thread::sleep_for(20ms); // so that this worker polls and the other one sleeps
    Workers asleep(server, 1, echo);
    std::this_thread::sleep_for(20ms);
    CHECK(client.call({}, 5s).status == CallStatus::ok);
    CHECK(client.call({}, 5s).status == CallStatus::ok);
    server.end_all_waits();
    once.join();
}

TEST_CASE("calls to a server with a polling worker wake no thread") {
    CallPair calls({.slots = 4, .max_bytes = 64}, {.spin = 60s});
    Workers workers(calls.server, 3, echo);
    const std::size_t rounds = 3000;
    std::vector<std::byte> results;
    for (std::size_t i = 0; i < rounds; ++i)
        REQUIRE(calls.client.call_into(bytes_of("x"), 60s, results) == CallStatus::ok);
    const auto counters = calls.client.counters();
    CHECK(counters.caller_wakes == 0);
    CHECK(counters.worker_wakes < rounds / 100); // the first calls come while the others lie down
}
