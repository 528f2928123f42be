// SPDX-License-Identifier: Apache-2.0
#include "fixture.hpp"

#include "shm/call_client.hpp"
#include "shm/call_server.hpp"

#include <future>
#include <map>
#include <mutex>

using namespace tandem::shm;
using namespace tandem::shm::test;
using Catch::Matchers::Contains;

namespace {

/// first calls, second serves.
struct CallPair : Pair {
    explicit CallPair(CallQueueOptions options = {.slots = 8, .max_bytes = 4096})
        : client(first->add_call_queue("c", options)), server((first->publish(), seen_by_second())) {}
    /// Through first's addresses: the thread sanitizer knows words by address, and would see no
    /// connection between the two mappings that the sides have in one process.
    CallQueueHandle seen_by_second() {
        auto handle = *second->find_call_queue(Side::first, "c");
        const auto same = *first->find_call_queue(Side::first, "c");
        handle.view = same.view;
        handle.times = same.times;
        return handle;
    }
    CallClient client;
    CallServer server;
};

/// Workers that run a function for every call until the server is interrupted.
struct Workers {
    Workers(CallServer& server, int count, std::function<void(IncomingCall&)> work) : server_(server) {
        for (int i = 0; i < count; ++i)
            threads_.emplace_back([&server, work] {
                for (;;) {
                    auto call = server.take(10s);
                    if (!call) return;
                    work(*call);
                }
            });
    }
    ~Workers() {
        server_.interrupt();
        for (auto& thread : threads_) thread.join();
    }
    CallServer& server_;
    std::vector<std::thread> threads_;
};

/// A call from a thread of its own; Catch's assertions are for one thread only.
std::future<CallStatus> call_aside(CallClient& client, std::chrono::nanoseconds timeout) {
    return std::async(std::launch::async, [&client, timeout] { return client.call(0, {}, timeout).status; });
}

void echo(IncomingCall& call) { call.reply(CallStatus::ok, call.arguments()); }

} // namespace

TEST_CASE("a call brings its arguments there and its results back") {
    CallPair calls;
    Workers workers(calls.server, 1, [](IncomingCall& call) {
        call.reply(CallStatus::ok, std::to_string(call.operation()) + ":" + text_of(call.arguments()));
    });
    const Reply reply = calls.client.call(5, bytes_of("args"), 20s);
    CHECK(reply.status == CallStatus::ok);
    CHECK(reply.text() == "5:args");
    CHECK(calls.client.call(0, {}, 20s).text() == "0:");
    CHECK(calls.client.counters().calls == 2);
    CHECK(calls.client.counters().in_use == 0);
}

TEST_CASE("an error of the service arrives as status and text") {
    CallPair calls;
    Workers workers(calls.server, 1, [](IncomingCall& call) {
        if (call.operation() == 1) call.reply(CallStatus::exception, "no chair");
        if (call.operation() == 2) call.reply(CallStatus::no_such_operation);
        if (call.operation() == 3) call.reply(CallStatus::ok, std::string(4096, 'x'));
        if (call.operation() == 4) call.reply(CallStatus::ok, std::vector<std::byte>(4097));
    });
    CHECK(calls.client.call(1, {}, 20s).status == CallStatus::exception);
    CHECK(calls.client.call(1, {}, 20s).text() == "no chair");
    CHECK(calls.client.call(2, {}, 20s).status == CallStatus::no_such_operation);
    CHECK(calls.client.call(3, {}, 20s).bytes.size() == 4096);
    CHECK_THAT(calls.client.call(4, {}, 20s).text(), Contains("4097 bytes"));
    CHECK(calls.client.call(5, {}, 20s).status == CallStatus::exception); // destroyed unanswered
    CHECK(calls.client.call(0, std::vector<std::byte>(4097), 20s).status == CallStatus::bad_arguments);
}

TEST_CASE("of calls from eight threads to four workers none is lost or doubled") {
    CallPair calls({.slots = 8, .max_bytes = 64});
    std::mutex guard;
    std::map<std::string, int> runs;
    Workers workers(calls.server, 4, [&](IncomingCall& call) {
        {
            const std::lock_guard lock(guard);
            ++runs[text_of(call.arguments())];
        }
        echo(call);
    });
    const std::size_t rounds = stress(2000);
    std::atomic<std::size_t> wrong{0};
    std::vector<std::thread> callers;
    for (int caller = 0; caller < 8; ++caller)
        callers.emplace_back([&, caller] {
            for (std::size_t i = 0; i < rounds; ++i) {
                const std::string text = std::to_string(caller) + "/" + std::to_string(i);
                const Reply reply = calls.client.call(0, bytes_of(text), 60s);
                if (reply.status != CallStatus::ok || reply.text() != text) ++wrong;
            }
        });
    for (auto& caller : callers) caller.join();
    CHECK(wrong == 0);
    CHECK(runs.size() == 8 * rounds);
    for (const auto& [text, count] : runs)
        if (count != 1) FAIL_CHECK(text << " ran " << count << " times");
    const auto counters = calls.client.counters();
    CHECK(counters.calls == 8 * rounds);
    CHECK(counters.taken == 8 * rounds);
    CHECK(counters.answered == 8 * rounds);
    CHECK(counters.in_use == 0);
}

TEST_CASE("a call that nobody takes ends at its deadline and is not run later") {
    CallPair calls;
    const auto before = now_ns();
    CHECK(calls.client.call(1, {}, 3ms).status == CallStatus::timeout);
    CHECK(now_ns() - before >= 3'000'000);
    CHECK_FALSE(calls.server.take(0ns));
    CHECK(calls.client.counters().in_use == 0);
    CHECK(calls.client.counters().timeouts == 1);
}

TEST_CASE("a call whose worker is too slow ends at its deadline and frees its slot when the worker is done") {
    CallPair calls({.slots = 1, .max_bytes = 64});
    auto caller = call_aside(calls.client, 50ms);
    auto call = calls.server.take(1s);
    CHECK(caller.get() == CallStatus::timeout);
    if (call) { // else the machine was so slow that the deadline passed first
        CHECK(calls.client.call(2, {}, 5ms).status == CallStatus::overload);
        call->reply(CallStatus::ok);
    }
    CHECK(calls.client.counters().in_use == 0);
    Workers workers(calls.server, 1, echo);
    CHECK(calls.client.call(3, bytes_of("x"), 20s).text() == "x");
}

TEST_CASE("when all slots are in use a further call is refused at once") {
    CallPair calls({.slots = 3, .max_bytes = 64});
    std::vector<std::future<CallStatus>> callers;
    for (int i = 0; i < 3; ++i) callers.push_back(call_aside(calls.client, 60s));
    REQUIRE(eventually([&] { return calls.client.counters().calls == 3; }));
    CHECK(calls.client.call(0, {}, 60s).status == CallStatus::overload);
    CHECK(calls.client.counters().overloads == 1);
    Workers workers(calls.server, 1, echo);
    for (auto& caller : callers) CHECK(caller.get() == CallStatus::ok);
}

TEST_CASE("waiting calls are taken in the order in which they came") {
    CallPair calls({.slots = 6, .max_bytes = 64});
    std::vector<std::thread> callers;
    for (std::uint32_t i = 0; i < 6; ++i) {
        callers.emplace_back([&, i] { calls.client.call(i, {}, 60s); });
        REQUIRE(eventually([&] { return calls.client.counters().calls == i + 1; }));
    }
    // the counter runs ahead of the last slot's state by a moment
    REQUIRE(eventually([&] { return calls.client.counters().in_use == 6; }));
    std::this_thread::sleep_for(5ms);
    for (std::uint32_t i = 0; i < 6; ++i) {
        auto call = calls.server.take(20s);
        REQUIRE(call);
        CHECK(call->operation() == i);
    }
    for (auto& caller : callers) caller.join();
}

TEST_CASE("an interrupt sends all idle workers home") {
    CallPair calls;
    const auto before = now_ns();
    {
        Workers workers(calls.server, 4, [](IncomingCall&) {});
        std::this_thread::sleep_for(1ms);
    } // joins the workers, each in a wait of 10 s
    CHECK_FALSE(calls.server.take(60s));
    CHECK(now_ns() - before < 9'000'000'000);
}

TEST_CASE("a server that shuts down refuses waiting and later calls and a new one serves again") {
    CallPair calls;
    auto caller = call_aside(calls.client, 60s);
    REQUIRE(eventually([&] { return calls.client.counters().calls == 1; }));
    calls.server.shut_down();
    // a call that slipped in behind is refused by the next look
    eventually([&] { return !calls.server.take(0ns) && calls.client.counters().in_use == 0; });
    CHECK(caller.get() == CallStatus::shut_down);
    CHECK(calls.client.call(0, {}, 60s).status == CallStatus::shut_down);
    CallServer again(*calls.second->find_call_queue(Side::first, "c"));
    Workers workers(again, 1, echo);
    CHECK(calls.client.call(0, {}, 60s).status == CallStatus::ok);
}

TEST_CASE("a client that shuts down gets its callers back") {
    CallPair calls;
    auto caller = call_aside(calls.client, 60s);
    REQUIRE(eventually([&] { return calls.client.counters().calls == 1; }));
    calls.client.shut_down();
    CHECK(caller.get() == CallStatus::shut_down);
    CHECK(calls.client.call(0, {}, 60s).status == CallStatus::shut_down);
    CHECK(calls.client.counters().in_use == 0);
}

TEST_CASE("calls that call back into the caller do not deadlock") {
    Pair pair;
    CallClient to_second(
        pair.first->add_call_queue("forth", {.callers = Side::first, .slots = 4, .max_bytes = 64}));
    CallServer at_first(
        pair.first->add_call_queue("back", {.callers = Side::second, .slots = 4, .max_bytes = 64}));
    pair.first->publish();
    CallServer at_second(*pair.second->find_call_queue(Side::first, "forth"));
    CallClient to_first(*pair.second->find_call_queue(Side::first, "back"));
    Workers workers_of_second(at_second, 2, [&](IncomingCall& call) {
        call.reply(CallStatus::ok, to_first.call(1, call.arguments(), 20s).bytes);
    });
    Workers workers_of_first(at_first, 2, echo);
    CHECK(to_second.call(1, bytes_of("there and back"), 20s).text() == "there and back");
}

TEST_CASE("each end of a call queue belongs to its side") {
    CallPair calls;
    CHECK_THROWS_AS(CallServer(*calls.first->find_call_queue(Side::first, "c")), Error);
    CHECK_THROWS_AS(CallClient(*calls.second->find_call_queue(Side::first, "c")), Error);
}
