// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/verdict.hpp"
#include "states.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace tandem::monitor;
using namespace tandem::monitor::test;
using tandem::shm::PeerState;

TEST_CASE("the verdict on healthy links is that all is well") {
    const Verdict verdict = judge(state_of({sound_link("a"), sound_link("b")}));
    CHECK(verdict.level == Level::well);
    CHECK(verdict.findings == 0);
    CHECK_THAT(verdict.reason, Catch::StartsWith("2 links: both hosts alive"));
}

TEST_CASE("the verdict lists the worst findings, from bad to good, and counts all") {
    std::vector<LinkState> links;
    for (std::size_t i = 0; i < 30; ++i) {
        links.push_back(sound_link("link" + std::to_string(i)));
        links.back().ports[0].missed_recently = 1;
    }
    links[3].sides[1].state = PeerState::dead;
    const Verdict verdict = judge(state_of(links));
    CHECK(verdict.findings == 31);
    REQUIRE(verdict.worst.size() == Verdict::max_worst);
    CHECK(verdict.worst[0].reason == verdict.reason);
    CHECK(verdict.worst[0].level == Level::dead);
    CHECK_THAT(verdict.worst[1].reason, Catch::StartsWith("link link0, port velocity: 1 missed deadline"));
    CHECK_THAT(verdict.worst[2].reason, Catch::StartsWith("link link1,"));
}

TEST_CASE("the verdict names what is wrong, and where") {
    LinkState link = sound_link();
    const auto check = [&](Level level, const std::string& reason) {
        const Verdict verdict = judge(state_of({sound_link("other"), link}));
        CHECK(verdict.level == level);
        CHECK(verdict.reason == reason);
        CHECK(verdict.findings == 1);
    };
    SECTION("a dead side") {
        link.sides[1].state = PeerState::dead;
        check(Level::dead, "link chair: the RTM host rtm_host (pid 22) has died");
    }
    SECTION("a stopped side") {
        link.sides[0].state = PeerState::stopped;
        check(Level::stopped,
              "link chair: the OPRoS host opros_host (pid 11) is stopped by a signal or a debugger");
    }
    SECTION("a side that has not joined") {
        link.sides[0] = {};
        check(Level::waiting, "link chair: the peer of the RTM host has not joined");
    }
    SECTION("a side that was there and is gone") {
        link.sides[1].state = PeerState::absent;
        link.sides[1].gone = true;
        check(Level::dead, "link chair: the RTM host rtm_host (pid 22) has died");
        link.sides[1].left = true;
        check(Level::gone, "link chair: the RTM host rtm_host (pid 22) has ended cleanly");
    }
    SECTION("a port of a type unknown to the other model") {
        link.shared_ports = {
            {"camera", "Eye0", "IDL:Raw:1.0", tandem::shm::Side::second, "out", "holds an Object"}};
        check(Level::mismatch, "link chair, port camera of Eye0: holds an Object");
    }
    SECTION("drops") {
        link.ports[0].lost_recently = 3;
        check(Level::dropping, "link chair, port velocity: 3 messages dropped in the last 5 s");
    }
    SECTION("messages of another type") {
        link.ports[0].undecodable_recently = 1;
        check(Level::dropping, "link chair, port velocity: 1 message not decodable in the last 5 s");
    }
    SECTION("a missed deadline") {
        link.ports[0].missed_recently = 1;
        check(Level::late, "link chair, port velocity: 1 missed deadline in the last 5 s");
    }
    SECTION("calls without an answer") {
        link.call_queues[0].failed_recently = 2;
        check(Level::late, "link chair, calls of the RTM host: 2 timed out or refused in the last 5 s");
    }
    SECTION("a damaged segment") {
        link.readable = false;
        link.reason = "truncated";
        check(Level::unreadable, "link chair: truncated");
    }
    SECTION("a damaged directory of objects") {
        link.damage = "entry 3 cannot be read";
        check(Level::unreadable, "link chair: entry 3 cannot be read");
    }
    SECTION("a damaged call queue") {
        link.call_queues[0].damage = "no queue";
        check(Level::unreadable, "link chair, calls of the RTM host: no queue");
    }
    SECTION("a side that has not published its ports") {
        link.sides[1].unpublished = true;
        check(Level::waiting,
              "link chair: the RTM host rtm_host (pid 22) has joined, but has not published its ports");
    }
    SECTION("a damaged ring") {
        link.ports[0].damage = "no ring";
        check(Level::unreadable, "link chair, port velocity: no ring");
    }
}

TEST_CASE("the verdict names the worst finding and the number of further ones") {
    LinkState late = sound_link("late"), dropping = sound_link("dropping"), dead = sound_link("dead");
    late.ports[0].missed_recently = 1;
    dropping.ports[0].lost_recently = 1;
    dead.sides[0].state = PeerState::dead;
    dead.sides[1].state = PeerState::stopped;
    const Verdict verdict = judge(state_of({late, dropping, dead}));
    CHECK(verdict.level == Level::dead);
    CHECK(verdict.findings == 4);
    CHECK(judge(state_of({late, dropping})).level == Level::dropping);
}

TEST_CASE("messages skipped by the reader's choice are not losses") {
    LinkState link = sound_link();
    link.ports[0].counters.skipped = 100;
    CHECK(judge(state_of({link})).level == Level::well);
}

TEST_CASE("the verdict without a link, and with another user's") {
    CHECK(judge(state_of({})).level == Level::no_link);
    LinkState foreign = sound_link();
    foreign.readable = false;
    foreign.foreign = true;
    CHECK(judge(state_of({foreign})).level == Level::no_link);
    CHECK(judge(state_of({foreign, sound_link()})).level == Level::well);
    State unseen;
    unseen.error = "/dev/shm: cannot be listed";
    CHECK(judge(unseen).level == Level::unreadable);
    CHECK(judge(unseen).reason == unseen.error);
}

TEST_CASE("overrunning ticks are reported as late or as bad by their share, and single overruns are not") {
    State state = state_of({sound_link()});
    TickState tick;
    tick.name = "ControlComp";
    tick.program = "opros_host";
    tick.pid = 11;
    tick.period_ns = 10'000'000;
    tick.ticks_recently = 500;
    const auto verdict = [&](std::uint64_t overruns) {
        tick.overruns_recently = overruns;
        state.ticks = {tick};
        return judge(state);
    };
    CHECK(verdict(0).level == Level::well);
    CHECK(verdict(4).level == Level::well);
    CHECK(verdict(5).level == Level::late);
    CHECK(verdict(49).level == Level::late);
    CHECK(verdict(50).level == Level::overrun);
    CHECK(verdict(50).reason ==
          "ControlComp in opros_host (pid 11): 50 of 500 ticks of 10 ms overran in the last 5 s");
    // The share of slow ticks is not meaningful for only a few ticks.
    tick.ticks_recently = 5;
    CHECK(verdict(2).level == Level::late);
    CHECK(verdict(3).level == Level::overrun);
}

TEST_CASE("a connection that a host could not make is reported with its ports and the reason") {
    State state = state_of({sound_link()});
    state.refused = {{"opros_host", 11, "Stick.position", "Adaptor.velocity", "app.xml:8: the types differ"}};
    const Verdict verdict = judge(state);
    CHECK(verdict.level == Level::mismatch);
    CHECK(verdict.reason == "opros_host (pid 11) could not connect Stick.position with Adaptor.velocity: "
                            "app.xml:8: the types differ");
}

TEST_CASE(
    "a hanging component is the worst finding, and one that takes the CPU from others is reported first") {
    LinkState dead = sound_link();
    dead.sides[0].state = PeerState::dead;
    State state = state_of({dead});
    TickState arm, logger;
    arm.name = "Legs";
    logger.name = "Logger";
    arm.program = logger.program = "opros_host";
    arm.pid = logger.pid = 11;
    arm.period_ns = logger.period_ns = 10'000'000;
    arm.overruns_recently = arm.ticks_recently = 100;
    logger.hang = HangState{"", "", 1000, 9};
    arm.hang = HangState{"Arm", "onExecute", 1000, 12.4};
    state.ticks = {logger, arm};
    const Verdict verdict = judge(state);
    CHECK(verdict.level == Level::hanging);
    CHECK(std::string(name_of(verdict.level)) == "hanging");
    CHECK(verdict.text == "A component hangs");
    CHECK_THAT(verdict.reason,
               Catch::StartsWith("Arm in opros_host (pid 11): onExecute has not returned since ") &&
                   Catch::EndsWith(" (12 s); its period is 10 ms"));
    CHECK(verdict.findings == 3); // both, and the dead host
    state.ticks = {logger};
    CHECK_THAT(judge(state).reason,
               Catch::StartsWith("Logger in opros_host (pid 11): its thread gets no CPU time since "));
}

TEST_CASE("components that are not active, and what a host does not do, are findings") {
    using tandem::process::ComponentState;
    using tandem::process::NoticeKind;
    State state = state_of({sound_link()});
    const auto check = [&](Level level, const std::string& reason) {
        CHECK(judge(state).level == level);
        CHECK(judge(state).reason == reason);
    };
    state.components = {{"rtm_host", 22, "Arm0", ComponentState::active}};
    CHECK(judge(state).level == Level::well);
    state.notices = {{"opros_host", 11, NoticeKind::setting, "memory is not locked"}};
    check(Level::setting, "opros_host (pid 11): memory is not locked");
    state.components[0].state = ComponentState::inactive;
    check(Level::inactive, "Arm0 in rtm_host (pid 22) is not active");
    state.components[0].state = ComponentState::error;
    check(Level::failed, "Arm0 in rtm_host (pid 22) is in ERROR; its host's log says why");
    state.components.clear();
    state.notices[0].kind = NoticeKind::component;
    check(Level::failed, "opros_host (pid 11): memory is not locked");
    state.notices[0] = {"rtm_host", 22, NoticeKind::lost, "the tool that observes Arm0 does not answer"};
    check(Level::dropping, "rtm_host (pid 22): the tool that observes Arm0 does not answer");
}

TEST_CASE("an active component of which each execution context is stopped is a finding") {
    const auto level = [](std::vector<HostContext> contexts) {
        State state = state_of({sound_link()});
        state.components = {{"rtm_host", 22, "Arm0", tandem::process::ComponentState::active}};
        HostInventory inventory;
        inventory.contexts = std::move(contexts);
        state.hosts = {{22, "rtm_host", {}, {"chair"}, std::make_shared<const HostInventory>(inventory)}};
        return judge(state).level;
    };
    const HostContext runs{"Arm0", "periodic", 1, true, {"Arm0"}},
        stopped{"Arm0", "periodic", 1, false, {"Arm0"}}, of_other{"Hand0", "periodic", 1, false, {"Hand0"}};
    CHECK(level({}) == Level::well);
    CHECK(level({runs, of_other}) == Level::well);
    CHECK(level({stopped, runs}) == Level::well);
    CHECK(level({stopped}) == Level::inactive);
}

TEST_CASE("what a scan could not read, and a recording that has failed, are findings") {
    State state = state_of({sound_link()});
    state.cut = "link chair: not all messages were read";
    CHECK(judge(state).level == Level::unseen);
    CHECK(judge(state).reason == state.cut);
    state.recording_failure = "recording to x.mcap: tandem record has failed";
    CHECK(judge(state).level == Level::unrecorded);
    CHECK(judge(state).reason == state.recording_failure);
}

TEST_CASE("each level has a separate name and text, and only one of them says that all is well") {
    std::set<std::string> names;
    for (int level = 0; level <= static_cast<int>(worst_level); ++level)
        CHECK(names.insert(name_of(static_cast<Level>(level))).second);
    CHECK(names.count("well") == 1);
}
