// SPDX-License-Identifier: Apache-2.0
#include "host/process/bounded_call.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace std::chrono_literals;
using tandem::process::BoundedCall;

TEST_CASE("a call that returns in time has run, in another thread") {
    std::thread::id runner;
    CHECK(BoundedCall::returns_within(30s, [&] { runner = std::this_thread::get_id(); }));
    CHECK(runner != std::this_thread::get_id());
    CHECK_FALSE(BoundedCall::any_running());
}

TEST_CASE("what a call throws in time is rethrown in the caller") {
    CHECK_THROWS_WITH(BoundedCall::returns_within(30s, [] { throw std::runtime_error("reason"); }), "reason");
    CHECK_FALSE(BoundedCall::any_running());
}

TEST_CASE("a call that takes too long is left behind and counted until it returns") {
    const auto may_return = std::make_shared<std::atomic<bool>>(false);
    CHECK_FALSE(BoundedCall::returns_within(10ms, [may_return] {
        while (!*may_return) std::this_thread::sleep_for(1ms);
    }));
    CHECK(BoundedCall::any_running());
    *may_return = true;
    for (int i = 0; i < 1000 && BoundedCall::any_running(); ++i) std::this_thread::sleep_for(10ms);
    CHECK_FALSE(BoundedCall::any_running());
}

TEST_CASE("the calls of a series run in order, in one thread as long as they return") {
    std::vector<std::size_t> calls;
    std::vector<std::thread::id> threads;
    BoundedCall::run_series({3,
                             [&](std::size_t i) {
                                 calls.push_back(i);
                                 threads.push_back(std::this_thread::get_id());
                             },
                             [](std::size_t) { return 30s; }, [](std::size_t) { return true; }});
    CHECK(calls == std::vector<std::size_t>{0, 1, 2});
    CHECK(threads == std::vector(3, threads.at(0)));
    CHECK(threads[0] != std::this_thread::get_id());
    CHECK_FALSE(BoundedCall::any_running());
}

TEST_CASE("a series continues without a call that takes too long, if its caller wants that") {
    const bool goes_on = GENERATE(true, false);
    struct Shared {
        std::atomic<bool> may_return{false};
        std::atomic<int> last_calls{0};
    };
    const auto shared = std::make_shared<Shared>();
    std::vector<std::size_t> left_behind;
    BoundedCall::run_series({3,
                             [shared](std::size_t i) {
                                 while (i == 1 && !shared->may_return) std::this_thread::sleep_for(1ms);
                                 if (i == 2) ++shared->last_calls;
                             },
                             [](std::size_t i) { return i == 1 ? 10ms : 30s; },
                             [&](std::size_t i) {
                                 left_behind.push_back(i);
                                 return goes_on;
                             }});
    CHECK(left_behind == std::vector<std::size_t>{1});
    CHECK(shared->last_calls == (goes_on ? 1 : 0));
    CHECK(BoundedCall::any_running());
    shared->may_return = true;
    for (int i = 0; i < 1000 && BoundedCall::any_running(); ++i) std::this_thread::sleep_for(10ms);
    CHECK_FALSE(BoundedCall::any_running());
    CHECK(shared->last_calls ==
          (goes_on ? 1 : 0)); // the call that was left behind is the last one of its thread
}

TEST_CASE("an exception ends a series and is rethrown in the caller") {
    int calls = 0;
    CHECK_THROWS_WITH(
        BoundedCall::run_series({3,
                                 [&](std::size_t) {
                                     ++calls;
                                     throw std::runtime_error("reason");
                                 },
                                 [](std::size_t) { return 30s; }, [](std::size_t) { return true; }}),
        "reason");
    CHECK(calls == 1);
}
