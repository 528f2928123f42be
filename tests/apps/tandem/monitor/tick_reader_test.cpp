// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/host_files/tick_reader.hpp"

#include <catch2/catch.hpp>
#include <unistd.h>

using namespace tandem::monitor;

namespace {

/// One link, whose first side is this process.
State state_of_this_process() {
    State state;
    state.links.emplace_back();
    SideState& side = state.links.back().sides[0];
    side.state = tandem::shm::PeerState::alive;
    side.pid = static_cast<std::uint32_t>(getpid());
    side.program = "test";
    return state;
}

} // namespace

TEST_CASE("no percentile of a tick's lateness is above the latest tick") {
    const tandem::rt::OwnTickSlot slot("control", 10'000'000);
    TickReader reader;
    State before = state_of_this_process();
    reader.read(before, 1'000'000'000);
    REQUIRE(before.ticks.size() == 1);
    CHECK(before.ticks[0].name == "control");

    const std::int64_t lateness_ns = 1100; // of the octave that ends at 2048
    tandem::rt::count(slot->lateness[tandem::rt::time_octave(lateness_ns)], 100);
    tandem::rt::count(slot->ticks, 100);
    slot->lateness_ns_max = lateness_ns;
    State after = state_of_this_process();
    reader.read(after, 2'000'000'000);
    REQUIRE(after.ticks.size() == 1);
    const TickState& tick = after.ticks[0];
    CHECK(tick.ticks_recently == 100);
    CHECK(tick.recent_lateness.samples == 100);
    CHECK(tick.recent_lateness.p50_ns == 1100);
    CHECK(tick.recent_lateness.p99_ns == 1100);
    CHECK(tick.recent_lateness.max_ns == 1100);
    CHECK(tick.recent_execution.samples == 0);
}

TEST_CASE("the execution times of the last seconds are read, and no percentile is above the longest cycle") {
    const tandem::rt::OwnTickSlot slot("control", 10'000'000);
    TickReader reader;
    tandem::rt::count(slot->execution[tandem::rt::time_octave(5'000'000)]);
    slot->execution_ns_max = 5'000'000;
    State before = state_of_this_process();
    reader.read(before, 1'000'000'000);
    tandem::rt::count(slot->execution[tandem::rt::time_octave(70'000)], 97);
    tandem::rt::count(slot->execution[tandem::rt::time_octave(300'000)], 3);
    State after = state_of_this_process();
    reader.read(after, 2'000'000'000);
    REQUIRE(after.ticks.size() == 1);
    const TickState& tick = after.ticks[0];
    CHECK(tick.longest_ns == 5'000'000);
    CHECK(tick.recent_execution.samples == 100);
    CHECK(tick.recent_execution.p50_ns == 131'072);
    CHECK(tick.recent_execution.p99_ns == 524'288);
    CHECK(tick.recent_execution.max_ns == 524'288);
}

namespace {

constexpr std::int64_t second_ns = 1'000'000'000;

/// Reads at these times, in seconds. Returns whether the last reading finds that the tick hangs. Later readings also find the
/// page through the descriptor with which this process reads it.
bool hangs_after(TickReader& reader, const std::vector<double>& looks) {
    bool hangs = false;
    for (const double at : looks) {
        State state = state_of_this_process();
        reader.read(state, static_cast<std::uint64_t>(at * 1e9));
        REQUIRE_FALSE(state.ticks.empty());
        hangs = state.ticks[0].hang.has_value();
    }
    return hangs;
}

} // namespace

TEST_CASE("a tick hangs if it is overdue by several periods and 0.6 s in two successive reads") {
    const tandem::rt::OwnTickSlot slot("control", 10'000'000);
    TickReader reader;
    CHECK_FALSE(hangs_after(reader, {100, 101})); // none is due
    slot->due_ns = 200 * second_ns;
    CHECK_FALSE(hangs_after(reader, {200.3, 200.5}));
    CHECK(hangs_after(reader, {200.7}));
    slot->due_ns = 300 * second_ns; // the host may have been stopped, so the first reading may be too early
    tandem::rt::count(slot->ticks);
    CHECK_FALSE(hangs_after(reader, {302}));
    CHECK(hangs_after(reader, {302.2}));
    slot->due_ns = 0;
    CHECK_FALSE(hangs_after(reader, {400, 401}));
}

TEST_CASE("a tick of a long period is not late after a second") {
    const tandem::rt::OwnTickSlot slot("logger", 10 * second_ns);
    TickReader reader;
    slot->due_ns = 100 * second_ns;
    CHECK_FALSE(hangs_after(reader, {101, 105, 129}));
    CHECK(hangs_after(reader, {130.5}));
}

TEST_CASE("a component whose activation takes long is reported as hanging only when its host reports it") {
    const tandem::rt::OwnTickSlot slot("camera", 10'000'000);
    TickReader reader;
    slot->due_ns = 100 * second_ns;
    std::string("onActivated").copy(slot->callback.callback, 11);
    CHECK_FALSE(hangs_after(reader, {101, 105, 115}));
    CHECK(hangs_after(reader, {117}));
}

TEST_CASE(
    "a hanging tick reports its callback and the start of its cycle, or that the thread is in no callback") {
    const tandem::rt::OwnTickSlot slot("control", 500'000'000);
    slot->due_ns = 100 * second_ns;
    TickReader reader;
    const auto look = [&] {
        State state = state_of_this_process();
        state.time_ms = 1'000'000;
        reader.read(state, 110 * second_ns);
        return state.ticks.at(0).hang;
    };
    look();
    auto hang = look();
    REQUIRE(hang);
    CHECK(hang->component.empty());
    CHECK(hang->since_ms == 990'000);
    std::string("Arm").copy(slot->callback.component, 4);
    std::string("on\nExecute").copy(slot->callback.callback, 11);
    hang = look();
    REQUIRE(hang);
    CHECK(hang->component == "Arm");
    CHECK(hang->callback.find('\n') == std::string::npos);
    CHECK(hang->since_ms == 989'500);
    CHECK(hang->seconds == 10.5);
}
