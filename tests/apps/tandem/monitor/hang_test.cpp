// SPDX-License-Identifier: Apache-2.0
// What the monitor sees of hosts whose components hang.
#include "tanks.hpp"

#include "apps/tandem/monitor/verdict.hpp"

#include <catch2/catch.hpp>

using namespace tandem::monitor;
using namespace tandem::monitor::test;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

bool has_hang(const State& state) { return judge(state).level == Level::hanging; }

/// Checks that this component hangs in this callback, and that no other component hangs.
void check_hang(Tanks& tanks, const std::string& component, const std::string& callback) {
    REQUIRE(tanks.sees(has_hang));
    const State state = tanks.look();
    std::vector<std::pair<std::string, std::string>> found;
    for (const auto& tick : state.ticks)
        if (tick.hang) found.emplace_back(tick.hang->component, tick.hang->callback);
    CHECK(found == std::vector{std::pair(component, callback)});
    CHECK_THAT(judge(state).reason, Contains(component + " in ") &&
                                        Contains(": " + callback + " has not returned since ") &&
                                        Contains("its period is 10 ms"));
}

} // namespace

TEST_CASE("only the hanging component is reported, with its callback") {
    Tanks tanks;
    SECTION("an RTC, after some cycles") {
        tanks.start_rtm({"", "hang later", ""});
        check_hang(tanks, "TankRtc1", "onExecute");
    }
    SECTION("an RTC, in its first cycle") {
        tanks.start_rtm({"", "hang", ""});
        check_hang(tanks, "TankRtc1", "onExecute");
    }
    SECTION("an OPRoS component, after some cycles") {
        tanks.start_opros({"", "hang later", ""});
        check_hang(tanks, "Tank1", "onExecute");
    }
    SECTION("an OPRoS component, in its first cycle") {
        tanks.start_opros({"", "hang", ""});
        check_hang(tanks, "Tank1", "onExecute");
    }
    SECTION("several OPRoS components in one thread: the one that blocks the others") {
        tanks.start_opros({"", "hang later", ""}, {}, "periodic-shared");
        check_hang(tanks, "Tank1", "onExecute");
    }
}

TEST_CASE("an inactive component is not reported as hanging") {
    Tanks tanks;
    tanks.start_rtm({"", "deactivates itself"});
    REQUIRE(tanks.sees([&](const State& state) { return tanks.ticking(state) == 1; }));
    std::this_thread::sleep_for(1500ms); // longer than a tick may be late
    CHECK_FALSE(has_hang(tanks.look()));
    CHECK_FALSE(has_hang(tanks.look()));
}

TEST_CASE("a component in lock-step is not reported as hanging while no cycle is requested") {
    Tanks tanks;
    SECTION("rtm_host") { tanks.start_rtm({"", ""}, {"--lockstep", tanks.socket()}); }
    SECTION("opros_host") { tanks.start_opros({"", ""}, {"--lockstep", tanks.socket()}); }
    REQUIRE(tanks.sees([&](const State&) { return std::filesystem::exists(tanks.socket()); }));
    std::this_thread::sleep_for(1500ms);
    CHECK_FALSE(has_hang(tanks.look()));
    CHECK_FALSE(has_hang(tanks.look()));
}
