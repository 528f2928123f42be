// SPDX-License-Identifier: Apache-2.0
// The verdict about hosts that cannot fulfil a request, such as a priority.
#include "tanks.hpp"

#include "apps/tandem/monitor/verdict.hpp"

#include <catch2/catch.hpp>

using namespace tandem::monitor;
using namespace tandem::monitor::test;
using Catch::Contains;

namespace {

/// Checks the level of the verdict, and that its text contains `named`.
void check_verdict(Tanks& tanks, Level level, const std::string& named) {
    Verdict verdict;
    tanks.sees([&](const State& state) {
        verdict = judge(state);
        return verdict.level == level && verdict.reason.find(named) != std::string::npos;
    });
    INFO(verdict.reason);
    CHECK(name_of(verdict.level) == std::string(name_of(level)));
    CHECK_THAT(verdict.reason, Contains(named));
}

} // namespace

TEST_CASE("a component that throws is in ERROR in the verdict, with the reason") {
    Tanks tanks;
    SECTION("an RTC") {
        tanks.start_rtm({"", "throws"});
        check_verdict(tanks, Level::failed, "TankRtc1 in rtm_host (pid ");
    }
    SECTION("an OPRoS component") {
        tanks.start_opros({"", "throws"});
        check_verdict(tanks, Level::failed, "Tank1 in opros_host (pid ");
    }
    check_verdict(tanks, Level::failed, ") is in ERROR: onExecute threw");
}

TEST_CASE("an event-driven component that does not return from its cycle hangs") {
    Tanks tanks;
    tanks.start_opros({"", "hang"}, {}, "aperiodic");
    check_verdict(tanks, Level::hanging, "Tank1 in opros_host (pid ");
}

TEST_CASE("an RTC that is deactivated is named by the verdict") {
    Tanks tanks;
    tanks.start_rtm({"", "deactivates itself"});
    check_verdict(tanks, Level::inactive, "TankRtc1 in rtm_host (pid ");
}

TEST_CASE("a component that could not be loaded is named by the verdict") {
    Tanks tanks;
    tanks.start_opros({"", "no library"});
    check_verdict(tanks, Level::failed, "component Tank1 is left out: ");
}

TEST_CASE("a processor that the kernel refuses is in the verdict") {
    Tanks tanks;
    SECTION("rtm_host") { tanks.start_rtm({""}, {"--cpu", "1023"}); }
    SECTION("opros_host") { tanks.start_opros({""}, {"--cpu", "1023"}); }
    check_verdict(tanks, Level::setting, "is not pinned to processor 1023: ");
}

TEST_CASE("a misspelt key of rtc.conf is in the verdict") {
    Tanks tanks;
    tanks.start_rtm({""}, {"-o", "exec_cxt.periodic.rat:100"});
    check_verdict(tanks, Level::setting, "exec_cxt.periodic.rat");
}
