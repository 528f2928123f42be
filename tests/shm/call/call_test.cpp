// SPDX-License-Identifier: Apache-2.0
#include "call_fixture.hpp"
#include "shm/call/call_worker.hpp"

#include <set>

using namespace tandem::shm;
using namespace tandem::shm::test;
using Catch::Contains;

TEST_CASE("a call carries its arguments to the worker and its results back") {
    CallPair calls;
    Workers workers(calls.server, 1, [](IncomingCall& call) {
        call.reply(CallStatus::ok, "got " + text_of(call.arguments()));
    });
    const Reply reply = calls.client.call(bytes_of("args"), 20s);
    CHECK(reply.status == CallStatus::ok);
    CHECK(reply.text() == "got args");
    CHECK(calls.client.call({}, 20s).text() == "got ");
    CHECK(calls.client.counters().calls == 2);
    CHECK(calls.client.counters().in_use == 0);
}

TEST_CASE("an error of the service arrives as status and text") {
    CallPair calls;
    Workers workers(calls.server, 1, [](IncomingCall& call) {
        const std::string text = text_of(call.arguments());
        if (text == "exception") call.reply(CallStatus::exception, "no chair");
        if (text == "unknown") call.reply(CallStatus::no_such_operation);
        if (text == "longest") call.reply(CallStatus::ok, std::string(4096, 'x'));
        if (text == "too long") call.reply(CallStatus::ok, std::vector<std::byte>(4097));
    });
    const auto call = [&](const char* text) { return calls.client.call(bytes_of(text), 20s); };
    CHECK(call("exception").status == CallStatus::exception);
    CHECK(call("exception").text() == "no chair");
    CHECK(call("unknown").status == CallStatus::no_such_operation);
    CHECK(call("longest").bytes.size() == 4096);
    CHECK_THAT(call("too long").text(), Contains("4097 bytes"));
    CHECK(call("destroyed unanswered").status == CallStatus::exception);
    CHECK(calls.client.call(std::vector<std::byte>(4097), 20s).status == CallStatus::bad_arguments);
}

TEST_CASE("a call that no worker takes ends at its deadline and is not run later") {
    CallPair calls;
    const auto before = now_ns();
    CHECK(calls.client.call({}, 3ms).status == CallStatus::timeout);
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
        CHECK(calls.client.call({}, 5ms).status == CallStatus::overload);
        call->reply(CallStatus::ok);
    }
    CHECK(calls.client.counters().in_use == 0);
    Workers workers(calls.server, 1, echo);
    CHECK(calls.client.call(bytes_of("x"), 20s).text() == "x");
}

TEST_CASE("waiting calls are taken in the order in which they came") {
    CallPair calls({.slots = 6, .max_bytes = 64});
    std::vector<std::thread> callers;
    for (std::uint32_t i = 0; i < 6; ++i) {
        callers.emplace_back([&, i] { calls.client.call(bytes_of(std::to_string(i)), 60s); });
        REQUIRE(eventually([&] { return calls.client.counters().calls == i + 1; }));
    }
    // the counter runs ahead of the last slot's state by a moment
    REQUIRE(eventually([&] { return calls.client.counters().in_use == 6; }));
    std::this_thread::sleep_for(5ms);
    for (std::uint32_t i = 0; i < 6; ++i) {
        auto call = calls.server.take(20s);
        REQUIRE(call);
        CHECK(number_of(*call) == i);
    }
    for (auto& caller : callers) caller.join();
}

TEST_CASE("end_all_waits() makes all idle workers return") {
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
    CHECK(calls.client.call({}, 60s).status == CallStatus::shut_down);
    CallServer again(*calls.second->find_call_queue(Side::first, "c"));
    Workers workers(again, 1, echo);
    CHECK(calls.client.call({}, 60s).status == CallStatus::ok);
}

TEST_CASE("a client that shuts down ends the calls of its callers") {
    CallPair calls;
    auto caller = call_aside(calls.client, 60s);
    REQUIRE(eventually([&] { return calls.client.counters().calls == 1; }));
    calls.client.shut_down();
    CHECK(caller.get() == CallStatus::shut_down);
    CHECK(calls.client.call({}, 60s).status == CallStatus::shut_down);
    CHECK(calls.client.counters().in_use == 0);
}

TEST_CASE("each end of a call queue belongs to its side") {
    CallPair calls;
    CHECK_THROWS_AS(CallServer(*calls.first->find_call_queue(Side::first, "c")), Error);
    CHECK_THROWS_AS(CallClient(*calls.second->find_call_queue(Side::first, "c")), Error);
}

TEST_CASE("a call queue has one calling end at a time") {
    CallPair calls;
    const auto queue = *calls.first->find_call_queue(Side::first, "c");
    CHECK_THROWS_WITH(CallClient(queue), Contains("already has a CallClient"));
    Pair pair;
    const auto other = pair.first->add_call_queue("c", {.slots = 2, .max_bytes = 64});
    for (int i = 0; i < 3; ++i) CHECK(CallClient(other).call({}, 1us).status == CallStatus::timeout);
}

TEST_CASE("a new calling end withdraws the calls that the last one left behind") {
    Pair pair;
    const auto queue = pair.first->add_call_queue("c", {.slots = 2, .max_bytes = 64});
    pair.first->publish();
    // Pretends that a caller was in the middle of two calls: one submitted, one taken by a worker.
    queue.view.slots[0].request.word.store(call_word(layout::CallState::submitted, 7, 0));
    queue.view.slots[1].request.word.store(call_word(layout::CallState::submitted, 9, 0));
    queue.view.slots[1].work.claim.store(call_word(0U, 9, 0));
    CallClient client(queue);
    CallServer server(*pair.second->find_call_queue(Side::first, "c"));
    CHECK_FALSE(server.take(0ns));
    CHECK(client.counters().in_use == 1); // the worker is still at it
    Workers workers(server, 1, echo);
    for (int i = 0; i < 3; ++i) CHECK(client.call(bytes_of("x"), 20s).text() == "x");
}

TEST_CASE("only waiting calls of dead callers are cancelled, and observers still see the answers of others") {
    CallPair calls({.slots = 2, .max_bytes = 64});
    const auto view = calls.second->find_call_queue(Side::first, "c")->view;
    {
        Workers workers(calls.server, 1, echo);
        CHECK(calls.client.call(bytes_of("x"), 20s).text() == "x");
    }
    const std::uint32_t one = view.slots[0].reply.word.load() != 0 ? 0 : 1; // the slot of that call
    const std::uint64_t answered = view.slots[one].request.word.load();
    const std::uint64_t waits = call_word(layout::CallState::submitted, 7, 0);
    view.slots[1 - one].request.word.store(waits);
    view.header->slots_used.store(1);
    CallWorker<RealAtomics>(view).drop_submitted();
    CHECK(view.slots[one].request.word.load() == answered);
    CHECK(view.slots[1 - one].request.word.load() == with_state(waits, layout::CallState::cancelled));
}

TEST_CASE("a late answer is dropped and does not reach the next call of its slot") {
    CallPair calls({.slots = 1, .max_bytes = 64});
    auto caller = call_aside(calls.client, 300s);
    auto late = calls.server.take(20s);
    REQUIRE(late);
    calls.client.shut_down();
    CHECK(caller.get() == CallStatus::shut_down);
    CHECK(calls.client.counters().in_use == 1);
    late->reply(CallStatus::ok, std::string("late"));
    CHECK(calls.client.counters().in_use == 0);
}

TEST_CASE("arguments and results of every length arrive whole") {
    CallPair calls;
    Workers workers(calls.server, 1, echo);
    for (std::size_t bytes = 0; bytes <= 4096; bytes += bytes < 300 ? 1 : 499) {
        std::vector<std::byte> arguments(bytes);
        for (std::size_t i = 0; i < bytes; ++i) arguments[i] = static_cast<std::byte>(i * 7 + bytes);
        const Reply reply = calls.client.call(arguments, 20s);
        REQUIRE(reply.status == CallStatus::ok);
        REQUIRE(reply.bytes == arguments);
    }
}

TEST_CASE("a call queue keeps counters and durations that anybody can read") {
    CallPair calls;
    const auto queue = *calls.second->find_call_queue(Side::first, "c");
    {
        Workers workers(calls.server, 2, echo);
        for (int i = 0; i < 100; ++i) CHECK(calls.client.call({}, 20s).status == CallStatus::ok);
    }
    const auto counters = read_counters(queue.view);
    CHECK(counters.calls == 100);
    CHECK(counters.taken == 100);
    CHECK(counters.answered == 100);
    CHECK(counters.in_use == 0);
    const auto total = [](const layout::Histogram& times) {
        std::uint64_t sum = 0;
        for (const auto& count : times.counts) sum += count;
        return sum;
    };
    CHECK(total(queue.times->round_trip) == 100);
    CHECK(total(queue.times->service) <= 100); // of two workers at the same time, one may not record its time
    CHECK(total(queue.times->service) > 0);
}

TEST_CASE("every status of a call has a different name") {
    std::set<std::string> names;
    for (std::uint32_t status = 0; status <= static_cast<std::uint32_t>(CallStatus::cancelled); ++status)
        names.insert(name_of(static_cast<CallStatus>(status)));
    CHECK(names.size() == 11);
    CHECK(names.count("unknown status") == 0);
    CHECK(name_of(static_cast<CallStatus>(99)) == std::string("unknown status"));
}
