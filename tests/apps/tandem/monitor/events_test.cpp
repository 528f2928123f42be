// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/events.hpp"
#include "states.hpp"

#include <catch2/catch.hpp>

using namespace tandem::monitor;
using namespace tandem::monitor::test;
using tandem::shm::PeerState;

namespace {

/// Returns the texts of the events between two states of one link; "!" marks a bad event.
std::vector<std::string> texts(const LinkState& before, const LinkState& after) {
    std::vector<std::string> texts;
    for (const Event& event : events_between(state_of({before}), state_of({after}))) {
        CHECK(event.link == after.name);
        texts.push_back((event.bad ? "!" : "") + event.text);
    }
    return texts;
}
using Texts = std::vector<std::string>;

} // namespace

TEST_CASE("links that come and go are events") {
    const auto came = events_between(state_of({}), state_of({sound_link()}));
    REQUIRE(came.size() == 1);
    CHECK(came[0].text == "the link exists, generation 1");
    const auto gone = events_between(state_of({sound_link()}), state_of({}));
    REQUIRE(gone.size() == 1);
    CHECK(gone[0].text == "the link no longer exists: its segment was removed");
    CHECK(events_between(state_of({sound_link()}), state_of({sound_link()})).empty());
}

TEST_CASE("a host without a link that is no longer there is a failure") {
    State alone = state_of({}), linked = state_of({sound_link()});
    alone.hosts = {{7, "rtm_host"}};
    linked.hosts = {{22, "rtm_host", {}, {"chair"}}};
    const auto gone = events_between(alone, state_of({}));
    REQUIRE(gone.size() == 1);
    CHECK(gone[0].bad);
    CHECK(gone[0].text == "rtm_host (pid 7) has ended or died");
    CHECK(events_between(alone, alone).empty());
    CHECK(events_between(linked, state_of({sound_link()})).empty()); // the link's sides say it
}

TEST_CASE("a state that could not be read is not an event") {
    State unseen;
    unseen.error = "/dev/shm: cannot be listed";
    CHECK(events_between(state_of({sound_link()}), unseen).empty());
}

TEST_CASE("a side that dies and starts again in a new generation causes two events") {
    LinkState dead = sound_link(), back = sound_link();
    dead.sides[1].state = PeerState::dead;
    CHECK(texts(sound_link(), dead) == Texts{"!the RTM host rtm_host (pid 22) has died"});
    CHECK(texts(dead, dead).empty());
    back.generation = 2;
    back.sides[1].pid = 33;
    CHECK(texts(dead, back) == Texts{"the link continues as generation 2; its counters start at zero",
                                     "the RTM host rtm_host (pid 33) has started again"});
}

TEST_CASE("a side that dies is a failure, and a side that ends cleanly is not") {
    LinkState ended = sound_link(), gone = sound_link();
    ended.sides[1].state = PeerState::dead;
    ended.sides[1].left = true;
    CHECK(texts(sound_link(), ended) == Texts{"the RTM host rtm_host (pid 22) has ended cleanly"});
    gone.sides[1].state = PeerState::absent;
    gone.sides[1].gone = gone.sides[1].left = true;
    CHECK(texts(sound_link(), gone) == Texts{"the RTM host rtm_host (pid 22) has ended cleanly"});
    CHECK(texts(ended, gone).empty());
}

TEST_CASE("after a restart between two states, the event says how the previous process ended") {
    LinkState again = sound_link();
    again.sides[1].pid = 33;
    CHECK(texts(sound_link(), again) == Texts{"!the RTM host rtm_host (pid 22) has died",
                                              "the RTM host rtm_host (pid 33) has started again"});
    again.sides[1].previous_left = true;
    CHECK(texts(sound_link(), again) == Texts{"the RTM host rtm_host (pid 22) has ended cleanly",
                                              "the RTM host rtm_host (pid 33) has started again"});
}

TEST_CASE("a link created again with the same generation is a new link") {
    LinkState anew = sound_link();
    anew.created_ns = 2000;
    CHECK(texts(sound_link(), anew) == Texts{"the link was created again; its counters start at zero"});
}

TEST_CASE("joining, stopping and continuing of a side are events") {
    LinkState absent = sound_link(), stopped = sound_link();
    absent.sides[0] = {};
    stopped.sides[0].state = PeerState::stopped;
    CHECK(texts(absent, sound_link()) == Texts{"the OPRoS host opros_host (pid 11) has joined"});
    CHECK(texts(sound_link(), stopped) == Texts{"!the OPRoS host opros_host (pid 11) is stopped"});
    CHECK(texts(stopped, sound_link()) == Texts{"the OPRoS host opros_host (pid 11) continues"});
}

TEST_CASE("drops, missed deadlines and failing calls are events when they begin") {
    LinkState bad = sound_link(), worse = sound_link();
    bad.ports[0].lost_recently = 1;
    bad.ports[0].missed_recently = 1;
    bad.call_queues[0].failed_recently = 1;
    worse = bad;
    worse.ports[0].lost_recently = 9;
    CHECK(texts(sound_link(), bad) == Texts{"!port velocity: drops start",
                                            "!port velocity: missed deadlines start",
                                            "!calls of the RTM host start failing"});
    CHECK(texts(bad, worse).empty());
    CHECK(texts(worse, sound_link()) ==
          Texts{"port velocity: no more drops", "port velocity: no more missed deadlines"});
}

TEST_CASE("the log keeps the newest 200 events and numbers all") {
    EventLog log;
    for (int i = 0; i < 300; ++i) log.add({{0, 1, false, "chair", std::to_string(i)}});
    REQUIRE(log.events().size() == EventLog::capacity);
    CHECK(log.events().front().text == "100");
    CHECK(log.events().back().number == 300);
}

TEST_CASE("a side whose peer continued without it is gone, and then starts again") {
    LinkState gone = sound_link(), back = sound_link();
    gone.generation = 2;
    gone.sides[1].state = PeerState::absent;
    gone.sides[1].gone = true;
    back.generation = 2;
    back.sides[1].pid = 33;
    CHECK(texts(sound_link(), gone) == Texts{"the link continues as generation 2; its counters start at zero",
                                             "!the RTM host rtm_host (pid 22) has died"});
    CHECK(texts(gone, gone).empty());
    CHECK(texts(gone, back) == Texts{"the RTM host rtm_host (pid 33) has started again"});
}

TEST_CASE("a refused connection is an event, and so is the end of the refusal") {
    const State sound = state_of({sound_link()});
    State refused = sound;
    refused.refused = {{"opros_host", 11, "Stick.position", "Adaptor.velocity", "the types differ"}};
    const auto begun = events_between(sound, refused);
    REQUIRE(begun.size() == 1);
    CHECK(begun[0].bad);
    CHECK(begun[0].link == "opros_host");
    CHECK(begun[0].text == "Stick.position and Adaptor.velocity are not connected: the types differ");
    CHECK(events_between(refused, refused).empty());
    const auto over = events_between(refused, sound);
    REQUIRE(over.size() == 1);
    CHECK_FALSE(over[0].bad);
    // When the host that refused the connection has ended, the problem remains: nothing connects the two ports.
    State ended = sound;
    ended.links[0].sides[0] = {};
    for (const auto& event : events_between(refused, ended)) CHECK(event.link == "chair");
}

TEST_CASE("hanging and continuing of a component are events") {
    State ticks = state_of({sound_link()});
    TickState tick;
    tick.name = "Arm";
    tick.program = "opros_host";
    tick.pid = 11;
    tick.period_ns = 10'000'000;
    ticks.ticks = {tick, tick};
    ticks.ticks[1].slot = 1; // two of one name
    State hangs = ticks;
    hangs.ticks[1].hang = HangState{"Arm", "onExecute", 1000, 1.2};
    const auto begins = events_between(ticks, hangs);
    REQUIRE(begins.size() == 1);
    CHECK(begins[0].bad);
    CHECK(begins[0].link == "opros_host");
    CHECK_THAT(begins[0].text, Catch::Contains("Arm in opros_host (pid 11): onExecute has not returned"));
    hangs.ticks[1].hang->seconds = 5;
    CHECK(events_between(hangs, hangs).empty());
    const auto ends = events_between(hangs, ticks);
    REQUIRE(ends.size() == 1);
    CHECK_FALSE(ends[0].bad);
    CHECK(ends[0].text == "Arm (pid 11) continues after 5 s");
    CHECK(events_between(state_of({sound_link()}), hangs).size() == 1); // the monitor was started late
}

TEST_CASE("components that fail, stop and return, and new notices, are events") {
    using tandem::process::ComponentState;
    State none = state_of({sound_link()}), active = none, failed = none, noted = none;
    active.components = {{"rtm_host", 22, "Arm0", ComponentState::active}};
    failed.components = {{"rtm_host", 22, "Arm0", ComponentState::error}};
    noted.notices = {{"rtm_host", 22, tandem::process::NoticeKind::setting, "memory is not locked"}};
    CHECK(events_between(none, active).empty());
    auto events = events_between(active, failed);
    REQUIRE(events.size() == 1);
    CHECK(events[0].bad);
    CHECK(events[0].text == "Arm0 in rtm_host (pid 22) is in ERROR; its host's log says why");
    events = events_between(failed, active);
    REQUIRE(events.size() == 1);
    CHECK_FALSE(events[0].bad);
    CHECK(events[0].text == "Arm0 (pid 22) is active");
    events = events_between(none, noted);
    REQUIRE(events.size() == 1);
    CHECK(events[0].text == "memory is not locked");
    CHECK(events_between(noted, noted).empty());
}
