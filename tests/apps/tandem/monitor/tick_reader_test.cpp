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
    tandem::rt::count(slot->lateness[tandem::rt::lateness_octave(lateness_ns)], 100);
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
}
