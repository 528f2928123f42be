// SPDX-License-Identifier: Apache-2.0
// Both sides of a link in one process, and the peer as a process that is killed.
#include "host/call/include/TandemCall.h"
#include "link_side.hpp"
#include "tests/support/skip.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

using namespace tandem;
using namespace tandem::link;
using namespace tandem::link::test;
TEST_CASE("data flow both ways whichever side opens first, and nothing is left behind") {
    const auto name = unique_name("flow");
    const bool adaptor_first = GENERATE(true, false);
    {
        auto a = adaptor(name), b = interceptor(name);
        (adaptor_first ? a : b)->link.open();
        (adaptor_first ? b : a)->link.open();
        wait_until_up(*a, *b);
        CHECK(a->table == joystick_table());
        for (int i = 0; i < 100; ++i) {
            REQUIRE(send(b->link.writer("reference"), i));
            REQUIRE(send(a->link.writer("position"), -i));
        }
        for (int i = 0; i < 100; ++i) {
            REQUIRE(receive(a->link.reader("reference")) == i);
            REQUIRE(receive(b->link.reader("position")) == -i);
        }
        CHECK(a->link.reader("reference").empty());
        CHECK_FALSE(receive(b->link.reader("position")));
    }
    CHECK(segments_of(name) == 0);
}

TEST_CASE("the segment is as large as the ports need, whichever side opens first") {
    const auto name = unique_name("many");
    const bool adaptor_first = GENERATE(true, false);
    PortTable table{{{"Many0"}}, {}};
    constexpr int ports = 100; // with 256 KiB each: six times the default of segment_mib
    for (int i = 0; i < ports; ++i)
        table.ports.push_back({PortKind::data_out, fmt::format("port{}", i), "T", "d", "", {}});
    auto a = adaptor(name);
    auto b = std::make_unique<LinkSide>(shm::Side::second, LinkOptions{name}, table);
    (adaptor_first ? a : b)->link.open();
    (adaptor_first ? b : a)->link.open();
    wait_until_up(*a, *b);
    REQUIRE(a->table == table);
    for (const char* port : {"port0", "port99"}) {
        REQUIRE(send(b->link.writer(port), 5));
        CHECK(receive(a->link.reader(port)) == 5);
    }
}

TEST_CASE("a listener is called once for arrived messages and not after it was removed") {
    const auto name = unique_name("listener");
    auto a = adaptor(name), b = interceptor(name);
    a->link.open();
    b->link.open();
    wait_until_up(*a, *b);
    std::atomic<int> calls{0};
    a->link.set_arrival_listener(a->link.reader("reference"), [&] { ++calls; });
    b->link.writer("reference").set_peer_listens(true);
    REQUIRE(send(b->link.writer("reference"), 1));
    REQUIRE(eventually([&] { return calls == 1; }));
    // The message is still unread, and announced nevertheless only once.
    std::this_thread::sleep_for(20ms);
    CHECK(calls == 1);
    a->link.set_arrival_listener(a->link.reader("reference"), {});
    REQUIRE(send(b->link.writer("reference"), 2));
    std::this_thread::sleep_for(20ms);
    CHECK(calls == 1);
}

TEST_CASE("the doorbell wakes the notifier for each message, including those of a peer that returned") {
    const auto name = unique_name("doorbell");
    auto a = adaptor(name);
    std::atomic<int> calls{0};
    a->link.set_arrival_listener(a->link.reader("reference"), [&] { ++calls; });
    a->link.open();
    for (int round = 0; round < 2; ++round) {
        auto b = interceptor(name);
        b->link.open();
        wait_until_up(*a, *b);
        b->link.writer("reference").set_peer_listens(true);
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < 20; ++i) {
            const int before = calls;
            REQUIRE(send(b->link.writer("reference"), i));
            REQUIRE(eventually([&] { return calls > before; }));
        }
        // Without the bell, each would wait for the notifier's bound of 1 s.
        CHECK(std::chrono::steady_clock::now() - start < 10s);
        b.reset();
        REQUIRE(eventually([&] { return a->downs == round + 1; }));
    }
}

TEST_CASE("a call says why it failed") {
    const auto name = unique_name("failure");
    auto a = adaptor(name);
    CHECK(a->link.call({"p", "o", "", {}}, soon).status == CallStatus::not_ready);
    a->link.open();
    CHECK(a->link.call({"p", "o", "", {}}, soon).status == CallStatus::not_ready);
    auto b = interceptor(name);
    std::atomic<bool> release{false};
    b->on_call = [&](const Request& request) {
        if (request.operation == "slow") eventually([&] { return release.load(); });
        return Reply::failure(CallStatus::exception, "the motor is hot");
    };
    b->link.open();
    a->link.wait_until_up(soon, "peer");
    const auto reply = a->link.call({"p", "o", "", {}}, soon);
    CHECK(reply.status == CallStatus::exception);
    CHECK(reply.text() == "the motor is hot");
    const auto late = a->link.call({"p", "slow", "", {}}, 10ms);
    CHECK(late.status == CallStatus::timeout);
    CHECK(late.bytes.empty()); // the caller knows its bound
    {
        const tandem::CallScope scope{tandem::CallHandle(20ms)};
        const auto bounded = a->link.call({"p", "slow", "", {}}, 10s);
        CHECK(bounded.status == CallStatus::timeout);
        CHECK(bounded.text() ==
              "no reply within 20 ms, the bound of its CallHandle, or not begun within 10000 ms");
    }
    release = true;
}

TEST_CASE("a peer that leaves and returns is bound again") {
    const auto name = unique_name("back");
    auto a = adaptor(name);
    a->link.open();
    for (int round = 1; round <= 3; ++round) {
        auto b = interceptor(name);
        b->link.open();
        wait_until_up(*a, *b);
        REQUIRE(send(b->link.writer("reference"), round));
        CHECK(receive(a->link.reader("reference")) == round);
        CHECK(eventually([&] { return a->came == round; }));
        b.reset();
        CHECK(eventually([&] { return a->downs == round && a->went == round; }));
        CHECK_FALSE(send(a->link.writer("position"), 0));
    }
    a.reset();
    CHECK(segments_of(name) == 0);
}

TEST_CASE("all consequences of a peer's departure are over before the next peer's first request") {
    const auto name = unique_name("departure");
    std::atomic<bool> deals_with_it{false}, may_return{false}, asked_too_early{false};
    auto a = adaptor(name), b = interceptor(name);
    a->on_departure = [&] {
        deals_with_it = true;
        eventually([&] { return may_return.load(); });
        deals_with_it = false;
    };
    a->on_call = [&](const Request&) {
        asked_too_early = asked_too_early || deals_with_it;
        return Reply{};
    };
    a->link.open();
    b->link.open();
    wait_until_up(*a, *b);
    b.reset();
    REQUIRE(eventually([&] { return deals_with_it.load(); }));
    b = interceptor(name);
    b->link.open();
    // Waits for a while to check that it does not happen.
    CHECK_THROWS_WITH(b->link.wait_until_up(100ms, "peer"), Catch::Contains("did not join"));
    CHECK(b->link.call({"", "activate", "", {}}, 100ms).status != CallStatus::ok);
    may_return = true;
    wait_until_up(*a, *b);
    CHECK(b->link.call({"", "activate", "", {}}, soon).status == CallStatus::ok);
    CHECK_FALSE(asked_too_early);
}

TEST_CASE("a segment that is truncated while in use takes the link down and a new one is joined") {
    const auto name = unique_name("truncated");
    const off_t bytes = GENERATE(off_t{0}, off_t{100}, off_t{8192}, off_t{2 << 20});
    CAPTURE(bytes);
    {
        auto a = adaptor(name), b = interceptor(name);
        a->link.open();
        b->link.open();
        wait_until_up(*a, *b);
        REQUIRE(send(b->link.writer("reference"), 1));
        const auto generations = shm::list_generations(name);
        REQUIRE(truncate(shm::segment_path(name, generations.at(0)).c_str(), bytes) == 0);
        // Every page is touched before the link looks, as a component in the middle of its tick would.
        send(b->link.writer("reference"), 2);
        receive(a->link.reader("reference"));
        a->link.call({"p", "o", "", {}}, 10ms);
        CHECK(eventually([&] { return a->downs == 1 && b->downs == 1; }));
        CHECK(eventually([&] { return a->link.is_up() && b->link.is_up(); }));
        // Messages that were on their way are lost, new ones arrive, and nothing else does.
        CHECK(eventually([&] { return send(b->link.writer("reference"), 3); }));
        CHECK(eventually([&] { return receive(a->link.reader("reference")) == 3; }));
        CHECK(a->link.call({"p", "o", "", bytes_of("again")}, soon).text() == "again");
    }
    CHECK(segments_of(name) == 0);
}

TEST_CASE("a mismatching table is refused with the reason, and a matching peer is accepted later") {
    const auto name = unique_name("refused");
    auto a = adaptor(name), b = interceptor(name);
    a->refusal = "port 'reference': ad is not ai";
    a->link.open();
    b->link.open();
    CHECK_THROWS_WITH(a->link.wait_until_up(soon, "peer"), "port 'reference': ad is not ai");
    b.reset();
    CHECK(eventually([&] { return segments_of(name) == 1; }));
    a->refusal.clear();
    b = interceptor(name);
    b->link.open();
    CHECK(eventually([&] { return a->link.is_up(); }));
}

TEST_CASE("a peer that never comes is reported with its name and the link") {
    const auto name = unique_name("nobody");
    auto a = adaptor(name);
    a->link.open();
    CHECK_THROWS_WITH(a->link.wait_until_up(20ms, "InterceptorComp"),
                      Catch::Contains(name) &&
                          Catch::Contains("InterceptorComp did not join within 0.02 s") &&
                          Catch::Contains("start it with link=" + name));
}

TEST_CASE("a peer that never comes because another user runs it is reported with the file and the remedy") {
    if (geteuid() != 0) TANDEM_SKIP("only root can make a file of another user");
    const auto name = unique_name("stranger");
    auto a = adaptor(name);
    a->link.open(); // before the other user, as the host that waits
    const auto path = shm::segment_path(name, shm::list_generations(name).back() + 1);
    std::ofstream(path).close();
    constexpr uid_t other_user = 12345;
    REQUIRE(chown(path.c_str(), other_user, other_user) == 0);
    CHECK_THROWS_WITH(a->link.wait_until_up(20ms, "InterceptorComp"),
                      Catch::Contains("InterceptorComp did not join within 0.02 s; " + path +
                                      " belongs to another user; run both hosts as one user"));
    std::filesystem::remove(path);
}

TEST_CASE("a killed peer is noticed, its calls end, and its successor is bound") {
    const auto name = unique_name("killed");
    int ready[2];
    REQUIRE(pipe(ready) == 0);
    const auto start_peer = [&] {
        const pid_t child = fork(); // nothing but this thread runs in the parent's copy
        if (child == 0) {
            auto b = interceptor(name);
            b->on_call = [](const Request&) {
                std::this_thread::sleep_for(60s);
                return Reply{};
            };
            b->link.open();
            b->link.wait_until_up(soon, "peer");
            [[maybe_unused]] const auto written = write(ready[1], "x", 1);
            for (int i = 0; i < 600; ++i) {
                send(b->link.writer("reference"), i);
                std::this_thread::sleep_for(100ms);
            }
            _exit(0);
        }
        return child;
    };
    // Both peers are forked before this process starts a thread; the second one waits for its turn.
    const pid_t first = start_peer();
    int turn[2];
    REQUIRE(pipe(turn) == 0);
    const pid_t second = fork();
    if (second == 0) {
        char go = 0;
        [[maybe_unused]] const auto got = read(turn[0], &go, 1);
        auto b = interceptor(name);
        b->link.open();
        for (int i = 0; i < 600; ++i) {
            send(b->link.writer("reference"), 1000 + i);
            std::this_thread::sleep_for(10ms);
        }
        _exit(0);
    }
    {
        auto a = adaptor(name);
        a->link.open();
        a->link.wait_until_up(soon, "peer");
        CHECK(eventually([&] { return receive(a->link.reader("reference")).has_value(); }));
        CallStatus ended = CallStatus::ok;
        std::thread caller([&] { ended = a->link.call({"p", "o", "", {}}, 60s).status; });
        std::this_thread::sleep_for(20ms);
        kill(first, SIGKILL);
        waitpid(first, nullptr, 0);
        caller.join();
        CHECK(ended == CallStatus::peer_died);
        CHECK(eventually([&] { return a->downs == 1; }));
        REQUIRE(write(turn[1], "x", 1) == 1);
        CHECK(eventually([&] { return receive(a->link.reader("reference")).value_or(0) >= 1000; }));
        kill(second, SIGKILL);
        waitpid(second, nullptr, 0);
    }
    CHECK(segments_of(name) == 0);
    for (const int end : {ready[0], ready[1], turn[0], turn[1]}) close(end);
}
