// SPDX-License-Identifier: Apache-2.0
#include "host/rt/shared_tick.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

using namespace std::chrono_literals;
using tandem::rt::SharedTick;
using Next = SharedTick::Next;

namespace {

/// A shared tick that counts its cycles and notes its thread.
struct Cell {
    explicit Cell(
        std::chrono::nanoseconds period, std::function<Next()> work = [] { return Next::tick; },
        Next first = Next::tick)
        : tick(SharedTick::start({period, {}, {}},
                                 {[this, work](const tandem::rt::ArrivedTick&) {
                                      overlaps += inside.exchange(true) ? 1 : 0;
                                      thread = std::this_thread::get_id();
                                      const Next next = work();
                                      inside = false;
                                      ++cycles;
                                      return next;
                                  },
                                  {},
                                  "cell",
                                  [this](const std::string& line) {
                                      const std::lock_guard lock(mutex);
                                      lines.push_back(line);
                                  }},
                                 first)) {}
    ~Cell() { tick->leave(1h); }
    bool reaches(int count) const {
        for (int i = 0; i < 10'000 && cycles < count; ++i) std::this_thread::sleep_for(1ms);
        return cycles >= count;
    }
    std::vector<std::string> log() {
        const std::lock_guard lock(mutex);
        return lines;
    }

    std::atomic<int> cycles{0}, overlaps{0};
    std::atomic<bool> inside{false};
    std::atomic<std::thread::id> thread{};
    std::mutex mutex;
    std::vector<std::string> lines;
    std::shared_ptr<SharedTick> tick;
};

} // namespace

TEST_CASE("shared ticks of one period need at most as many threads as processors") {
    std::vector<std::unique_ptr<Cell>> cells;
    for (int i = 0; i < 200; ++i) cells.push_back(std::make_unique<Cell>(10ms));
    std::set<std::thread::id> threads;
    for (const auto& cell : cells) {
        REQUIRE(cell->reaches(3));
        threads.insert(cell->thread);
        CHECK(cell->overlaps == 0);
    }
    // A machine that stops for a moment may have given some a separate thread.
    CHECK(threads.size() <= std::thread::hardware_concurrency() + 4);
}

TEST_CASE("a shared tick that rests runs once for each time it is woken, and its neighbours do not") {
    Cell neighbour(1h);
    Cell cell(
        1h, [] { return Next::rest; }, Next::rest);
    for (int i = 1; i <= 3; ++i) {
        cell.tick->wake();
        REQUIRE(cell.reaches(i));
    }
    CHECK(cell.cycles == 3);
    CHECK(neighbour.cycles == 0);
}

TEST_CASE("a shared tick that is woken in a cycle, which then rests, runs again") {
    std::atomic<bool> again{true};
    std::shared_ptr<SharedTick> tick;
    Cell cell(
        1h,
        [&] {
            if (again.exchange(false)) tick->wake();
            return Next::rest;
        },
        Next::rest);
    tick = cell.tick;
    tick->wake();
    CHECK(cell.reaches(2));
}

TEST_CASE("a shared tick that is woken and changed in a cycle, which then rests, runs again") {
    std::atomic<bool> again{true};
    std::shared_ptr<SharedTick> tick;
    Cell cell(
        1h,
        [&] {
            if (again.exchange(false)) {
                tick->wake();
                tick->change({2h, {}, {}});
            }
            return Next::rest;
        },
        Next::rest);
    tick = cell.tick;
    tick->wake();
    CHECK(cell.reaches(2));
}

TEST_CASE("a cycle that waits for a long time gets a separate thread, and its neighbours keep theirs") {
    Cell one(10ms), two(10ms);
    Cell slow(10ms, [] {
        std::this_thread::sleep_for(4ms);
        return Next::tick;
    });
    REQUIRE(slow.reaches(3));
    REQUIRE(one.reaches(5));
    REQUIRE(two.reaches(5));
    CHECK(slow.thread.load() != one.thread.load());
    REQUIRE(slow.log().size() == 1);
    // The second on a machine that stops for a moment.
    CHECK_THAT(slow.log()[0], Catch::StartsWith("cell has a separate thread: its cycle took ") ||
                                  Catch::StartsWith("cell keeps its thread: "));
}

TEST_CASE("the neighbours of a cycle that hangs get another thread") {
    std::atomic<bool> hangs{true};
    Cell one(5ms);
    Cell hanging(5ms, [&] {
        while (hangs) std::this_thread::sleep_for(1ms);
        return Next::tick;
    });
    Cell two(5ms);
    Cell resting(
        5ms, [] { return Next::rest; }, Next::rest);
    CHECK(one.reaches(20));
    CHECK(two.reaches(20));
    resting.tick->wake();
    CHECK(resting.reaches(1));
    CHECK(hanging.cycles == 0);
    CHECK_FALSE(hanging.tick->leave(1ms));
    hangs = false;
    CHECK(hanging.tick->leave(1h));
    CHECK(hanging.cycles == 1);
}

TEST_CASE("a cycle that hangs after its tick has left keeps no neighbour from running and leaving") {
    std::atomic<bool> hangs{true};
    const bool leaves_at_once = GENERATE(false, true);
    Cell neighbour(5ms);
    Cell hanging(5ms, [&] {
        while (hangs) std::this_thread::sleep_for(1ms);
        return Next::tick;
    });
    while (!hanging.inside) std::this_thread::sleep_for(1ms);
    CHECK_FALSE(hanging.tick->leave(0ns));
    if (!leaves_at_once) CHECK(neighbour.reaches(neighbour.cycles + 5));
    CHECK(neighbour.tick->leave(1h));
    hangs = false;
}

TEST_CASE("no cycle begins after leave(), and a cycle that calls leave() is the last one") {
    Cell cell(1ms);
    REQUIRE(cell.reaches(3));
    CHECK(cell.tick->leave(1h));
    const int cycles = cell.cycles;
    std::shared_ptr<SharedTick> tick;
    std::atomic<bool> is_set{false}, has_left{false};
    Cell own(1ms, [&] {
        if (is_set) has_left = tick->leave(1h);
        return Next::tick;
    });
    tick = own.tick;
    is_set = true;
    while (!has_left) std::this_thread::sleep_for(1ms);
    CHECK(tick->leave(1h));
    const int own_cycles = own.cycles;
    std::this_thread::sleep_for(10ms);
    CHECK(own.cycles == own_cycles);
    CHECK(cell.cycles == cycles);
}

TEST_CASE("a shared tick changes its period from outside and in its cycle") {
    Cell neighbour(1h);
    Cell cell(1h);
    cell.tick->change({1ms, {}, {}});
    CHECK(cell.reaches(5));
    std::shared_ptr<SharedTick> tick;
    std::atomic<bool> is_set{false};
    Cell own(2ms, [&] {
        if (is_set) tick->change({1ms, {}, {}});
        return Next::tick;
    });
    tick = own.tick;
    is_set = true;
    CHECK(own.reaches(20));
    CHECK(own.overlaps == 0);
    CHECK(neighbour.cycles == 0);
}

TEST_CASE("a shared tick that is alone in its thread changes its period") {
    Cell cell(1h);
    cell.tick->change({2h, {}, {}});
    cell.tick->change({1ms, {}, {}});
    CHECK(cell.reaches(5));
}

TEST_CASE("only the first ticks of a process have separate threads") {
    std::vector<std::shared_ptr<void>> tokens;
    while (auto token = tandem::rt::take_separate_tick_thread()) tokens.push_back(std::move(token));
    CHECK(tokens.size() == 16);
    tokens.pop_back();
    CHECK(tandem::rt::take_separate_tick_thread() != nullptr);
}
