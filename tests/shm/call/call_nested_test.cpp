// SPDX-License-Identifier: Apache-2.0
// Calls that call back: a chain alternates between two queues, one for each direction.
#include "call_fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// A call whose arguments begin with the n-th character after '0' makes the peer call back with n - 1, down to 0. The reply of
/// the last one comes back through all.
struct TwoWays : Pair {
    TwoWays(std::uint32_t slots, int workers)
        : to_second(first->add_call_queue("forth", options(Side::first, slots))),
          at_first((first->add_call_queue("back", options(Side::second, slots)), first->publish(),
                    *first->find_call_queue(Side::first, "back"))),
          at_second(*second->find_call_queue(Side::first, "forth")),
          to_first(*second->find_call_queue(Side::first, "back")),
          workers_of_second(at_second, workers, [this](IncomingCall& call) { go_down(call, to_first); }),
          workers_of_first(at_first, workers, [this](IncomingCall& call) { go_down(call, to_second); }) {}

    static CallQueueOptions options(Side callers, std::uint32_t slots) {
        return {.callers = callers, .slots = slots, .max_bytes = 64};
    }
    void go_down(IncomingCall& call, CallClient& onward) {
        std::string text = text_of(call.arguments());
        if (text.at(0) == '0') return call.reply(CallStatus::ok, text.substr(1));
        --text[0];
        const Reply reply = onward.call(bytes_of(text), timeout);
        call.reply(reply.status, reply.bytes);
    }
    Reply call(CallClient& client, std::size_t depth, const std::string& text) const {
        return client.call(bytes_of(static_cast<char>('0' + depth) + text), timeout);
    }

    std::chrono::nanoseconds timeout = 20s; // of each call

    CallClient to_second;
    CallServer at_first, at_second;
    CallClient to_first;
    Workers workers_of_second, workers_of_first;
};

} // namespace

TEST_CASE("calls that call back into the caller do not deadlock") {
    TwoWays ways(4, 4);
    // A chain of 8 calls enters each queue 4 times: it needs all slots and all workers of both.
    for (std::size_t depth = 0; depth < 8; ++depth)
        CHECK(ways.call(ways.to_second, depth, "there and back").text() == "there and back");
    CHECK(ways.to_second.counters().in_use == 0);
    CHECK(ways.to_first.counters().in_use == 0);
}

TEST_CASE("many simultaneous chains of nested calls from both sides all return") {
    TwoWays ways(16, 12);
    std::atomic<std::size_t> wrong{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&, i] {
            auto& client = i % 2 == 0 ? ways.to_second : ways.to_first;
            for (std::size_t round = 0; round < stress(100); ++round) {
                const std::string text = std::to_string(i) + "/" + std::to_string(round);
                const Reply reply = ways.call(client, round % 5, text);
                if (reply.status != CallStatus::ok || reply.text() != text) ++wrong;
            }
        });
    for (auto& thread : threads) thread.join();
    CHECK(wrong == 0);
}

TEST_CASE("two chains of 17 nested calls at once return if both queues have slots and workers for both") {
    TwoWays ways(18, 18);
    for (std::size_t round = 0; round < 20; ++round) {
        auto chain = [&] { return ways.call(ways.to_second, 16, "deep").text(); };
        auto other = std::async(std::launch::async, chain);
        CHECK(chain() == "deep");
        CHECK(other.get() == "deep");
    }
}

TEST_CASE("a chain of nested calls too long for the slots ends at its deadline") {
    TwoWays ways(2, 4);
    CHECK(ways.call(ways.to_second, 3, "x").status == CallStatus::ok);
    ways.timeout = 50ms;
    const auto status = ways.call(ways.to_second, 4, "x").status;
    CHECK((status == CallStatus::overload || status == CallStatus::timeout));
    ways.timeout = 20s;
    CHECK(
        eventually([&] { return ways.to_second.counters().in_use + ways.to_first.counters().in_use == 0; }));
    CHECK(ways.call(ways.to_second, 3, "x").status == CallStatus::ok);
}

TEST_CASE("a chain of nested calls too long for the workers ends at its deadline") {
    TwoWays ways(8, 2);
    ways.timeout = 50ms;
    CHECK(ways.call(ways.to_second, 4, "x").status == CallStatus::timeout);
    ways.timeout = 20s;
    CHECK(
        eventually([&] { return ways.to_second.counters().in_use + ways.to_first.counters().in_use == 0; }));
    CHECK(ways.call(ways.to_second, 3, "x").status == CallStatus::ok);
}
