// SPDX-License-Identifier: Apache-2.0
// A side that is stopped for a while: it is not dead, and afterwards it continues as if nothing had happened.
#include "../shm/fixture.hpp"
#include "shared.hpp"

#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include "shm/inspect/observer.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

struct Flags {
    std::atomic<bool> no_more{false}, done{false};
    std::atomic<std::uint64_t> counted{0};
};

JoinOptions large() { return small(std::size_t{8} << 20); }

/// 0.6 s, in the long run 5 s. The process stays alive, observers see it as stopped, and no other process can take its side.
void stay_stopped(const Link& link, const Segment& survivor) {
    const auto observed_state = [&] {
        const auto seen = observe(link.name);
        return seen ? seen->segment.side(other(survivor.side())).state : PeerState::absent;
    };
    REQUIRE(eventually([&] { return observed_state() == PeerState::stopped; }));
    const auto until = deadline_after(std::chrono::milliseconds(stress(600, 5000)));
    while (now_ns() < until) {
        REQUIRE(survivor.peer_state() == PeerState::alive);
        REQUIRE(observed_state() == PeerState::stopped);
        REQUIRE_FALSE(survivor.superseded());
        std::this_thread::sleep_for(5ms);
    }
    CHECK_THROWS_AS(join(link, other(survivor.side()), large()), SideTaken);
}

} // namespace

TEST_CASE("a writer that was stopped continues without a gap") {
    Link link;
    Shared<Flags> flags;
    auto first = join(link, Side::first, large());
    RingReader reader(first->add_ring("r", {.writer = Side::second, .max_record = 8, .capacity = 4 << 20}));
    first->publish();
    // The ring holds far more than the writer sends between two looks of the reader, so nothing is dropped.
    Child writing([&] {
        auto second = join(link, Side::second, large());
        RingWriter writer(*second->find_ring(Side::first, "r"));
        for (std::uint64_t number = 1; !flags->no_more; ++number) {
            writer.write(std::as_bytes(std::span(&number, 1)), number);
            if (number % 64 == 0) std::this_thread::sleep_for(500us);
        }
        flags->counted = writer.counters().sent;
        flags->done = true;
        for (;;) pause();
        return 0;
    });
    std::uint64_t received = 0;
    bool in_order = true;
    const auto drain = [&] {
        while (const auto record = reader.read()) {
            ++received;
            in_order = in_order && record->stamp_ns == received && record->sequence == received;
        }
    };
    REQUIRE(eventually([&] { return drain(), received > 1000; }));
    REQUIRE(kill(writing.pid(), SIGSTOP) == 0);
    stay_stopped(link, *first);
    drain();
    const std::uint64_t before = received;
    REQUIRE(kill(writing.pid(), SIGCONT) == 0);
    CHECK(eventually(
        [&] { return drain(), first->peer_state() == PeerState::alive && received > before + 1000; }));
    flags->no_more = true;
    REQUIRE(eventually([&] { return drain(), flags->done.load(); }));
    drain();
    CHECK(in_order);
    CHECK(received == flags->counted);
    CHECK(reader.counters().dropped() == 0);
}

TEST_CASE("a reader that was stopped has missed what was dropped, and the counters add up") {
    Link link;
    Shared<Flags> flags;
    auto first = join(link, Side::first, large());
    RingWriter writer(first->add_ring("r", {.max_record = 8, .capacity = 4096}));
    first->publish();
    Child reading([&] {
        auto second = join(link, Side::second, large());
        RingReader reader(*second->find_ring(Side::first, "r"));
        std::uint64_t last = 0;
        for (;;) {
            const bool last_look = flags->no_more;
            while (const auto record = reader.read()) {
                if (record->stamp_ns <= last) return 1;
                last = record->stamp_ns;
                ++flags->counted;
            }
            if (last_look) break;
            std::this_thread::sleep_for(50us);
        }
        flags->done = true;
        for (;;) pause();
        return 0;
    });
    std::uint64_t number = 0;
    const auto write = [&] {
        ++number;
        writer.write(std::as_bytes(std::span(&number, 1)), number);
        if (number % 32 == 0) std::this_thread::sleep_for(50us);
        return true;
    };
    REQUIRE(eventually([&] { return write() && flags->counted > 100; }));
    REQUIRE(kill(reading.pid(), SIGSTOP) == 0);
    for (int i = 0; i < 10'000; ++i) write();
    stay_stopped(link, *first);
    CHECK(writer.counters().dropped() > 1000);
    const std::uint64_t before = flags->counted;
    REQUIRE(kill(reading.pid(), SIGCONT) == 0);
    CHECK(eventually([&] { return write() && flags->counted > before + 100; }));
    flags->no_more = true;
    REQUIRE(eventually([&] { return flags->done.load(); }));
    const RingCounters counters = writer.counters();
    CHECK(counters.sent == number);
    CHECK(counters.received == flags->counted);
    CHECK(counters.sent == counters.received + counters.dropped());
    CHECK(first->peer_state() != PeerState::dead);
}

TEST_CASE("a call to a worker that was stopped ends by its deadline and the next is answered") {
    Link link;
    auto first = join(link, Side::first, large());
    CallClient client(first->add_call_queue("c", {.slots = 4, .max_bytes = 64}));
    first->publish();
    Child serving([&] {
        auto second = join(link, Side::second, large());
        CallServer server(*second->find_call_queue(Side::first, "c"));
        for (;;) {
            if (auto call = server.take(5ms)) call->reply(CallStatus::ok, call->arguments());
        }
        return 0;
    });
    REQUIRE(client.call(bytes_of("x"), 20s).status == CallStatus::ok);
    REQUIRE(kill(serving.pid(), SIGSTOP) == 0);
    CHECK(client.call(bytes_of("y"), 30ms).status == CallStatus::timeout);
    stay_stopped(link, *first);
    REQUIRE(kill(serving.pid(), SIGCONT) == 0);
    CHECK(client.call(bytes_of("z"), 20s).text() == "z");
    const CallCounters counters = client.counters();
    CHECK(counters.calls == 3);
    CHECK(counters.timeouts == 1);
    CHECK(counters.in_use == 0);
    CHECK(counters.answered == 2); // the call that timed out was withdrawn and has not run
}
