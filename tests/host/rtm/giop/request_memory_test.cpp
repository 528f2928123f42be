// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/network/request_memory.hpp"
#include <catch2/catch.hpp>
#include <future>

using RTC::RequestMemory;
using RTC::TakenMemory;

namespace {

constexpr std::chrono::milliseconds at_once{0};
constexpr std::chrono::seconds soon{20};

} // namespace

TEST_CASE("Requests of one client share its memory, and those of another client have their own") {
    RequestMemory memory(100, 250);
    TakenMemory first, second, other, third;
    CHECK(memory.take(first, "10.0.0.1", 80, at_once));
    CHECK_FALSE(memory.take(second, "10.0.0.1", 40, at_once));
    CHECK(memory.take(other, "process 4711", 100, at_once));
    CHECK_FALSE(memory.take(third, "process 4712", 80, at_once)); // of all
    memory.give_back(first);
    CHECK(memory.take(second, "10.0.0.1", 40, at_once));
    CHECK(memory.take(third, "process 4712", 80, at_once));
}

TEST_CASE("Two requests that have arrived in part do not wait for each other") {
    RequestMemory memory(100, 400);
    TakenMemory first, second;
    REQUIRE(memory.take(first, "10.0.0.1", 50, at_once));
    REQUIRE(memory.take(second, "10.0.0.1", 50, at_once));
    CHECK(memory.take(first, "10.0.0.1", 30, at_once)); // exceeds the memory of its client
    CHECK_FALSE(memory.take(second, "10.0.0.1", 30, at_once));
    auto waiting = std::async(std::launch::async, [&] { return memory.take(second, "10.0.0.1", 30, soon); });
    CHECK(memory.take(first, "10.0.0.1", 20, at_once));
    memory.give_back(first);
    CHECK(waiting.get());
}
