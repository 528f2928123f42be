// SPDX-License-Identifier: Apache-2.0
#include "fixture.hpp"

#include "shm/call_client.hpp"
#include "shm/call_server.hpp"

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
    CHECK(client.call(1, bytes_of("x"), 300s).status == CallStatus::peer_died);
    CHECK(now_ns() - before < 60'000'000'000);
    killer.join();
    CHECK(client.call(1, {}, 300s).status == CallStatus::peer_died); // and so does the next, taken by nobody
    CHECK(client.counters().in_use == 0);
}

TEST_CASE("a killed caller's slots are freed and its running call does no harm") {
    Link link;
    auto second = join(link, Side::second);
    CallServer server(second->add_call_queue("c", {.callers = Side::first, .slots = 4, .max_bytes = 64}));
    second->publish();
    Child calling([&] {
        auto first = join(link, Side::first);
        CallClient client(*first->find_call_queue(Side::second, "c"));
        std::thread other([&] { client.call(2, {}, 300s); });
        client.call(1, bytes_of("x"), 300s);
        return 0;
    });
    auto running = server.take(30s);
    REQUIRE(running);
    REQUIRE(eventually([&] { return server.counters().calls == 2; }));
    calling.kill_now();
    CHECK(second->peer() == PeerState::dead);
    running->reply(CallStatus::ok, std::string("too late"));
    // The other call may have been submitted completely or not: either it is handed out once more or just
    // freed.
    if (auto left = server.take(0ns)) left->reply(CallStatus::ok);
    CHECK_FALSE(server.take(1ms));
    CHECK(server.counters().in_use == 0);
}
