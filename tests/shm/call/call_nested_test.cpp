// SPDX-License-Identifier: Apache-2.0
// Calls that call back: a chain alternates between two queues, one for each direction.
#include "call_fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

/// A call with operation n makes the other side call back with n - 1, down to 0.
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
        if (call.operation() == 0) return echo(call);
        const auto left =
            std::chrono::nanoseconds(call.deadline_ns() - std::min(now_ns(), call.deadline_ns()));
        const Reply reply = onward.call(call.operation() - 1, call.arguments(), left);
        call.reply(reply.status, reply.bytes);
    }

    CallClient to_second;
    CallServer at_first, at_second;
    CallClient to_first;
    Workers workers_of_second, workers_of_first;
};

} // namespace

TEST_CASE("calls that call back into the caller do not deadlock") {
    TwoWays ways(4, 4);
    // A chain of 8 calls enters each queue 4 times: it needs all slots and all workers of both.
    for (std::uint32_t depth = 0; depth < 8; ++depth)
        CHECK(ways.to_second.call(depth, bytes_of("there and back"), 20s).text() == "there and back");
    CHECK(ways.to_second.counters().in_use == 0);
    CHECK(ways.to_first.counters().in_use == 0);
}

TEST_CASE("many chains of nested calls at once from both sides all come back") {
    TwoWays ways(16, 12);
    std::atomic<std::size_t> wrong{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&, i] {
            auto& client = i % 2 == 0 ? ways.to_second : ways.to_first;
            for (std::size_t round = 0; round < stress(100); ++round) {
                const std::string text = std::to_string(i) + "/" + std::to_string(round);
                const Reply reply = client.call(static_cast<std::uint32_t>(round % 5), bytes_of(text), 60s);
                if (reply.status != CallStatus::ok || reply.text() != text) ++wrong;
            }
        });
    for (auto& thread : threads) thread.join();
    CHECK(wrong == 0);
}

TEST_CASE("a chain of nested calls too long for the slots ends with overload and no deadlock") {
    TwoWays ways(2, 4);
    CHECK(ways.to_second.call(3, bytes_of("x"), 20s).status == CallStatus::ok);
    CHECK(ways.to_second.call(4, bytes_of("x"), 20s).status == CallStatus::overload);
    CHECK(ways.to_second.call(3, bytes_of("x"), 20s).status == CallStatus::ok);
}

TEST_CASE("a chain of nested calls too long for the workers ends at its deadline") {
    TwoWays ways(8, 2);
    CHECK(ways.to_second.call(4, bytes_of("x"), 50ms).status == CallStatus::timeout);
    CHECK(
        eventually([&] { return ways.to_second.counters().in_use + ways.to_first.counters().in_use == 0; }));
    CHECK(ways.to_second.call(3, bytes_of("x"), 20s).status == CallStatus::ok);
}
