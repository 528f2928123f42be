// SPDX-License-Identifier: Apache-2.0
#include "call_fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

TEST_CASE("a caller whose server is killed in the call learns it long before the deadline") {
    Link link;
    auto first = join(link, Side::first);
    CallClient client(first->add_call_queue("c", {.slots = 2, .max_bytes = 64}));
    first->publish();
    Child serving([&] {
        auto second = join(link, Side::second);
        CallServer server(*second->find_call_queue(Side::first, "c"));
        auto call = server.take(30s);
        for (;;) pause();
        return 0;
    });
    std::thread killer([&] {
        eventually([&] { return client.counters().taken == 1; });
        kill(serving.pid(), SIGKILL);
    });
    const auto before = now_ns();
    CHECK(client.call(bytes_of("x"), 300s).status == CallStatus::peer_died);
    CHECK(now_ns() - before < 60'000'000'000);
    killer.join();
    CHECK(client.call({}, 300s).status == CallStatus::peer_died); // also a call that no worker has taken
    CHECK(client.counters().in_use == 0);
}

TEST_CASE("the slots of a killed caller become free, and its running call does no harm") {
    Link link;
    auto second = join(link, Side::second);
    CallServer server(second->add_call_queue("c", {.callers = Side::first, .slots = 4, .max_bytes = 64}));
    second->publish();
    Child calling([&] {
        auto first = join(link, Side::first);
        CallClient client(*first->find_call_queue(Side::second, "c"));
        std::thread other([&] { client.call({}, 300s); });
        client.call(bytes_of("x"), 300s);
        return 0;
    });
    auto running = server.take(30s);
    REQUIRE(running);
    REQUIRE(eventually([&] { return server.counters().calls == 2; }));
    calling.kill_now();
    CHECK(second->peer_state() == PeerState::dead);
    running->reply(CallStatus::ok, std::string("too late"));
    // If the other call was submitted completely, it is handed out once more; otherwise its slot is freed.
    if (auto left = server.take(0ns)) left->reply(CallStatus::ok);
    CHECK_FALSE(server.take(1ms));
    CHECK(server.counters().in_use == 0);
}

TEST_CASE("a server killed at any moment gives every caller an error or its result") {
    for (std::size_t round = 0; round < stress(20); ++round) {
        Link link;
        auto first = join(link, Side::first);
        CallClient client(first->add_call_queue("c", {.slots = 4, .max_bytes = 64}));
        first->publish();
        Child serving([&] {
            auto second = join(link, Side::second);
            CallServer server(*second->find_call_queue(Side::first, "c"));
            Workers workers(server, 2, echo);
            for (;;) pause();
            return 0;
        });
        std::atomic<std::size_t> wrong{0}, died{0};
        std::vector<std::thread> callers;
        for (int caller = 0; caller < 3; ++caller)
            callers.emplace_back([&, caller] {
                for (std::size_t i = 0;; ++i) {
                    const std::string text = std::to_string(caller) + "/" + std::to_string(i);
                    const Reply reply = client.call(bytes_of(text), 300s);
                    if (reply.status == CallStatus::ok && reply.text() != text) ++wrong;
                    if (reply.status == CallStatus::ok) continue;
                    ++(reply.status == CallStatus::peer_died ? died : wrong);
                    return;
                }
            });
        const std::uint64_t replies = round * 17 % 500;
        CHECK(eventually([&] { return client.counters().answered > replies; }));
        serving.kill_now();
        const auto killed = now_ns();
        for (auto& caller : callers) caller.join();
        CHECK(now_ns() - killed < 60'000'000'000);
        CHECK(wrong == 0);
        CHECK(died == 3);
        CHECK(client.counters().in_use == 0);
    }
}

TEST_CASE("a server serves new callers after callers were killed at any moment") {
    Link link;
    for (std::size_t round = 0; round < stress(20); ++round) {
        auto second = join(link, Side::second);
        CallServer server(second->add_call_queue("c", {.callers = Side::first, .slots = 4, .max_bytes = 64}));
        second->publish();
        Child calling([&] {
            auto first = join(link, Side::first);
            CallClient client(*first->find_call_queue(Side::second, "c"));
            std::vector<std::thread> callers;
            for (int i = 0; i < 3; ++i)
                callers.emplace_back([&] {
                    for (;;) client.call(bytes_of("x"), 300s);
                });
            for (;;) pause();
            return 0;
        });
        std::atomic<std::uint64_t> runs{0};
        Workers workers(server, 2, [&](IncomingCall& call) {
            ++runs;
            echo(call);
        });
        CHECK(eventually([&] { return runs > round * 17 % 500; }));
        calling.kill_now();
        // A call that was submitted completely may still run; then the queue is empty and stays so.
        CHECK(eventually([&] { return server.counters().in_use == 0; }));
        const auto counters = server.counters();
        CHECK(counters.taken == counters.answered);
        CHECK(counters.answered == runs);
    }
}
