// SPDX-License-Identifier: Apache-2.0
#include "host/process/bounded_call.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <memory>
#include <stdexcept>
#include <thread>

using namespace std::chrono_literals;
using tandem::process::BoundedCall;

TEST_CASE("a call that returns in time has run, in another thread") {
    std::thread::id runner;
    CHECK(BoundedCall::returns_within(30s, [&] { runner = std::this_thread::get_id(); }));
    CHECK(runner != std::this_thread::get_id());
    CHECK_FALSE(BoundedCall::any_running());
}

TEST_CASE("what a call throws in time is thrown at the caller") {
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
