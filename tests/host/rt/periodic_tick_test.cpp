// SPDX-License-Identifier: Apache-2.0
#include "host/rt/crossings.hpp"
#include "host/rt/periodic_tick.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

using namespace std::chrono_literals;
using tandem::rt::monotonic_ns;
using tandem::rt::PeriodicTick;
using tandem::rt::TickOptions;

TEST_CASE("an aligned tick is planned on the grid plus the phase, and never comes early") {
    PeriodicTick tick({.period = 2ms, .phase = 500us});
    for (int i = 0; i < 5; ++i) {
        tick.wait();
        CHECK((tick.planned_ns() - tandem::rt::grid_origin.count()) % 2'000'000 == 500'000);
        CHECK(monotonic_ns() >= tick.planned_ns());
    }
    CHECK(tick.stats().ticks == 5);
}

TEST_CASE("two aligned ticks of one period share a grid") {
    PeriodicTick a({.period = 3ms}), b({.period = 3ms});
    a.wait();
    b.wait();
    CHECK((b.planned_ns() - a.planned_ns()) % 3'000'000 == 0);
}

TEST_CASE("a tick that is not aligned comes at once and starts its own grid") {
    PeriodicTick tick({.period = 10s, .aligned = false});
    const auto before = monotonic_ns();
    tick.wait();
    CHECK(tick.planned_ns() >= before);
    CHECK(tick.planned_ns() <= monotonic_ns());
}

TEST_CASE("work longer than several periods drops the missed ticks and keeps the grid") {
    PeriodicTick tick({.period = 2ms});
    tick.wait();
    const auto first = tick.planned_ns();
    std::this_thread::sleep_for(11ms);
    const auto skipped = tick.wait();
    CHECK(skipped >= 4);
    CHECK((tick.planned_ns() - first) == static_cast<std::int64_t>(skipped + 1) * 2'000'000);
    CHECK(tick.stats().overruns == 1);
    CHECK(tick.stats().skipped == skipped);
}

TEST_CASE("a spinning tick does not come early either") {
    PeriodicTick tick({.period = 2ms, .spin = 1ms});
    tick.wait();
    CHECK(monotonic_ns() >= tick.planned_ns());
    CHECK(tick.stats().lateness_ns_last >= 0);
}

TEST_CASE(
    "the rehearsal is repeated shortly before a tick that is polled for, and never runs without polling") {
    int rehearsals = 0, most = 0;
    PeriodicTick spinning({.period = 2ms, .spin = 1ms, .rehearse = [&] { ++rehearsals; }});
    // Each tick, unless the machine keeps the thread from its 1 ms.
    for (int i = 0; i < 1000 && most < 3; ++i) {
        const int before = rehearsals;
        spinning.wait();
        most = std::max(most, rehearsals - before);
    }
    CHECK(most >= 3);

    rehearsals = 0;
    PeriodicTick sleeping({.period = 2ms, .rehearse = [&] { ++rehearsals; }});
    for (int i = 0; i < 5; ++i) sleeping.wait();
    CHECK(rehearsals == 0);
}

TEST_CASE("a rehearsal that takes long is not repeated before the same tick") {
    int rehearsals = 0;
    PeriodicTick tick({.period = 20ms, .spin = 15ms, .rehearse = [&] {
                           ++rehearsals;
                           std::this_thread::sleep_for(100us); // as long as the time of repetitions
                       }});
    for (int i = 0; i < 20; ++i) {
        const int before = rehearsals;
        tick.wait();
        CHECK(rehearsals - before <= 1);
    }
    CHECK(rehearsals > 0);
}

namespace {

/// A tick that no user has given a spin. Each of its rehearsals reports one more message if `messages_cross`.
struct DefaultTick {
    explicit DefaultTick(std::chrono::nanoseconds period)
        : tick({.period = period, .spin = std::nullopt, .rehearse = [this] {
                    ++rehearsals;
                    if (messages_cross) ++messages;
                    tandem::rt::note_crossings(messages);
                }}) {}
    /// Returns whether it polls for one of so many ticks: it then rehearses more than to look for messages.
    bool polls_within(int ticks) {
        for (int i = 0; i < ticks; ++i) {
            const int before = rehearsals;
            tick.wait();
            if (rehearsals > before + 1) return true;
        }
        return false;
    }
    bool messages_cross = true;
    std::uint64_t messages = 0;
    int rehearsals = 0;
    PeriodicTick tick;
};

} // namespace

TEST_CASE("ticks without a spin set by the user poll for at most a tenth of a processor together") {
    auto first = std::make_unique<DefaultTick>(2ms); // polls for 100 us: a twentieth
    DefaultTick second(2ms), third(2ms);
    CHECK(first->polls_within(1000));
    second.tick.wait(); // takes the other twentieth, or the first already polls for more than its own
    CHECK_FALSE(third.polls_within(5));
    first.reset(); // its share is free again
    DefaultTick fourth(2ms);
    CHECK(fourth.polls_within(1000));
}

TEST_CASE("a tick without a spin set by the user does not poll while no message crosses") {
    DefaultTick tick(5ms);
    tick.messages_cross = false;
    CHECK_FALSE(tick.polls_within(100));
    CHECK(tick.rehearsals > 0);
    CHECK(tick.rehearsals < 20); // looks for messages
    tick.messages_cross = true;
    CHECK(tick.polls_within(1000));
    tick.messages_cross = false;
    for (int i = 0; i < 400; ++i) tick.tick.wait(); // 2 s
    CHECK_FALSE(tick.polls_within(100));
}

TEST_CASE("an interrupted tick ends a long wait without counting a tick") {
    PeriodicTick tick({.period = 1h});
    std::thread waiter([&] { tick.wait(); });
    tick.interrupt();
    waiter.join();
    CHECK(tick.interrupted());
    CHECK(tick.stats().ticks == 0);
}

TEST_CASE("ticks that are interrupted one after the other do not wait for their times") {
    PeriodicTick clock({.period = 90ms});
    clock.wait();
    for (int i = 0; i < 100; ++i) {
        PeriodicTick tick({.period = 1h});
        std::thread waiter([&] { tick.wait(); });
        std::this_thread::sleep_for(1ms); // most threads are asleep by then
        tick.interrupt();
        waiter.join();
    }
    CHECK(clock.wait() < 50);
}

TEST_CASE("a tick that another object has waited for overruns if the cycle before has ended after it") {
    PeriodicTick tick({.period = 1h});
    constexpr std::int64_t hour = std::chrono::nanoseconds(1h).count();
    const std::int64_t now = tandem::rt::monotonic_ns();
    tick.tick_at({now - 2 * hour, now - 2 * hour});
    tick.tick_at({now - hour, now - hour / 2, true});
    CHECK(tick.stats().overruns == 1);
    CHECK(tick.stats().skipped == 0);
    tick.tick_at({now, now, false});
    CHECK(tick.stats().overruns == 1);
    CHECK(tick.stats().ticks == 3);
}

TEST_CASE("a period of zero is refused") {
    CHECK_THROWS_AS(PeriodicTick({.period = 0ns}), std::invalid_argument);
}
