// SPDX-License-Identifier: Apache-2.0
#include "host/rt/cycle_lines.hpp"
#include "host/rt/rehearsal.hpp"
#include "host/rt/shared_tick.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <thread>

using namespace std::chrono_literals;
using tandem::rt::CycleLines;
using tandem::rt::SharedTick;

TEST_CASE("the lines of a cycle have a limit, and only a rehearsal that collects them adds some") {
    std::array<std::byte, 8192> object{};
    tandem::rt::note_lines(object.data(), object.size());
    CycleLines lines;
    tandem::rt::this_thread_lines = &lines;
    tandem::rt::note_lines(object.data(), 0);
    CHECK(lines.count() == 0);
    for (std::size_t i = 0; i < CycleLines::most_runs + 5; ++i)
        tandem::rt::note_lines(object.data() + i, object.size());
    tandem::rt::this_thread_lines = nullptr;
    CHECK(lines.count() == CycleLines::most_runs);
    lines.prefetch();
    lines.clear();
    CHECK(lines.count() == 0);
}

TEST_CASE("a shared tick rehearses its cycle once in 64, and its cycles are no rehearsals") {
    std::atomic<int> cycles{0}, rehearsals{0}, wrong{0}, too_early{0};
    std::int64_t rehearsed = 0;
    const auto is_rehearsal = [] {
        return tandem::rt::rehearsing() && tandem::rt::this_thread_lines != nullptr;
    };
    const auto tick = SharedTick::start({1ms, {}, {}},
                                        {[&](const tandem::rt::ArrivedTick& arrived) {
                                             wrong += is_rehearsal() ? 1 : 0;
                                             too_early += arrived.now < rehearsed ? 1 : 0;
                                             ++cycles;
                                             return SharedTick::Next::tick;
                                         },
                                         [&] {
                                             wrong += is_rehearsal() ? 0 : 1;
                                             ++rehearsals;
                                             rehearsed = tandem::rt::monotonic_ns();
                                         },
                                         "cell", [](const std::string&) {}},
                                        SharedTick::Next::tick);
    for (int i = 0; i < 10'000 && cycles < 200; ++i) std::this_thread::sleep_for(1ms);
    CHECK(tick->leave(1h));
    CHECK(cycles >= 200);
    CHECK(rehearsals >= cycles / 64 - 1);
    CHECK(rehearsals <= cycles / 64 + 1);
    CHECK(wrong == 0);
    CHECK(too_early == 0); // a rehearsal is no part of the cycle's duration
}
