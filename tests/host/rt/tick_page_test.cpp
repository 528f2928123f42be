// SPDX-License-Identifier: Apache-2.0
// What another process sees of the ticks of this one, by its open files.
#include "host/rt/periodic_tick.hpp"
#include "host/rt/tick_page.hpp"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

using namespace tandem::rt;
using namespace std::chrono_literals;

namespace {

/// The page, read as another process reads it.
TickPage page_of_this_process() {
    TickPage page{};
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        std::error_code gone;
        if (std::filesystem::read_symlink(entry.path(), gone) !=
            "/memfd:" + std::string(TickPage::file_name) + " (deleted)")
            continue;
        const int file = open(entry.path().c_str(), O_RDONLY);
        CHECK(pread(file, &page, sizeof page, 0) == static_cast<ssize_t>(sizeof page));
        close(file);
    }
    return page;
}

std::optional<TickSlot> slot_named(const std::string& name) {
    const TickPage page = page_of_this_process();
    for (const TickSlot& slot : page.slot)
        if (slot.period_ns != 0 && slot.name == name) return slot;
    return {};
}

} // namespace

TEST_CASE("ticks are counted where another process can read them, until they have ended") {
    {
        PeriodicTick tick({.period = 1ms, .name = "Plant0"});
        for (int i = 0; i < 20; ++i) tick.wait();
        const auto slot = slot_named("Plant0");
        REQUIRE(slot);
        CHECK(std::string(page_of_this_process().magic, 8) == std::string(TickPage::magic_text, 8));
        CHECK(slot->period_ns == 1'000'000);
        CHECK(slot->ticks == 20);
        std::uint64_t samples = 0;
        for (const auto count : slot->lateness) samples += count;
        CHECK(samples == 20);
        const TickStats stats = tick.stats();
        CHECK(slot->overruns == stats.overruns);
        CHECK(slot->lateness_ns_max == stats.lateness_ns_max);
    }
    CHECK_FALSE(slot_named("Plant0"));
}

TEST_CASE("the page tells when the next tick is due, or that none is") {
    PeriodicTick tick({.period = 1ms, .name = "Plant0"});
    CHECK(slot_named("Plant0")->due_ns == 0);
    tick.wait();
    CHECK(slot_named("Plant0")->due_ns == tick.planned_ns() + 1'000'000);
    tick.rest();
    CHECK(slot_named("Plant0")->due_ns == 0);
    const auto before = monotonic_ns();
    tick.begin_cycle(); // the first after a rest
    CHECK(slot_named("Plant0")->due_ns >= before + 1'000'000);
    tick.interrupt();
    tick.wait();
    CHECK(slot_named("Plant0")->due_ns == 0);
}

TEST_CASE("each cycle adds its duration to the page, once") {
    const auto cycles_of = [](const std::string& name) {
        const TickSlot slot = slot_named(name).value();
        std::uint64_t cycles = 0;
        for (const auto count : slot.execution) cycles += count;
        return cycles;
    };
    PeriodicTick tick({.period = 1ms, .name = "Plant0"});
    tick.wait();
    CHECK(cycles_of("Plant0") == 0);
    const auto began = monotonic_ns();
    while (monotonic_ns() < began + 100'000) continue; // the cycle
    tick.wait();                                       // ends it
    CHECK(cycles_of("Plant0") == 1);
    CHECK(slot_named("Plant0")->execution_ns_max >= 100'000);
    tick.rest();
    tick.wait();
    CHECK(cycles_of("Plant0") == 1); // no cycle ended
    tick.begin_cycle();
    tick.wait();
    CHECK(cycles_of("Plant0") == 2);

    PeriodicTick shared({.period = 1ms, .name = "Arm"});
    const auto now = monotonic_ns();
    shared.tick_at({now, now});
    CHECK(cycles_of("Arm") == 0);
    shared.tick_at({now + 1'000'000, now + 1'000'000, false, 2'000});
    CHECK(cycles_of("Arm") == 1);
    CHECK(slot_named("Arm")->execution_ns_max == 2'000);
}

TEST_CASE("ticks beyond the room of the page count for themselves alone") {
    std::vector<std::unique_ptr<PeriodicTick>> ticks;
    for (std::size_t i = 0; i < TickPage::slots + 3; ++i)
        ticks.push_back(
            std::make_unique<PeriodicTick>(TickOptions{.period = 1ms, .name = "t" + std::to_string(i)}));
    CHECK(slot_named("t0"));
    CHECK_FALSE(slot_named("t" + std::to_string(TickPage::slots + 2)));
    ticks.back()->wait();
    CHECK(ticks.back()->stats().ticks == 1);
    ticks.clear();
    PeriodicTick next({.period = 1ms, .name = std::string(500, 'n')});
    CHECK(slot_named(std::string(79, 'n')));
}

TEST_CASE("a time falls into the octave that it does not reach the end of") {
    CHECK(time_octave(-5) == 0);
    CHECK(time_octave(63) == 0);
    CHECK(time_octave(64) == 1);
    CHECK(time_octave(127) == 1);
    CHECK(time_octave(1'000'000) == 14);
    CHECK(time_octave(INT64_MAX) == TickSlot::octaves - 1);
}
