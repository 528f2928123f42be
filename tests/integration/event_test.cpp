// SPDX-License-Identifier: Apache-2.0
// OPRoS events and an RTC's data ports of id and content.
#include "two_hosts.hpp"

#include <catch2/catch.hpp>

using Catch::Contains;

namespace {

/// AlarmComp and AlarmRtc, joined by these connections.
struct AlarmHosts : TwoHosts {
    explicit AlarmHosts(const std::string& connections, const std::string& event_ports = "raised, answer") {
        set_talker("AlarmComp");
        set_rtc("AlarmRtc");
        set_adaptor_properties("<property name=\"event_ports\">" + event_ports + "</property>");
        set_connections(connections);
    }
};

} // namespace

TEST_CASE(
    "an OPRoS event reaches the RTC as a structure of id and content, and the RTC's answer is an event") {
    AlarmHosts hosts(TwoHosts::connection("event", "Talker", "alarm", "Adaptor", "raised") +
                     TwoHosts::connection("event", "Adaptor", "answer", "Talker", "notice"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "event: answer to hot 1 at a time, 0\n"));
    CHECK(hosts.says("opros", "event: answer to hot 2 at a time, 5\n"));
    CHECK(hosts.says("opros", "event: answer to hot 9 at a time, 19\n"));
    INFO(hosts.output("opros") + hosts.output("rtm"));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("events arrive again after the RTM host was killed and restarted") {
    AlarmHosts hosts(TwoHosts::connection("event", "Talker", "alarm", "Adaptor", "raised") +
                     TwoHosts::connection("event", "Adaptor", "answer", "Talker", "notice"));
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "event: answer to hot 3"));
    const std::size_t killed = hosts.restart_rtm("opros");
    CHECK(hosts.says("opros", "event: answer to hot ", killed));
    CHECK(hosts.stop_both());
}

TEST_CASE("events whose content differs from the RTC's structure are refused with both signatures") {
    AlarmHosts hosts(TwoHosts::connection("event", "Talker", "number", "Adaptor", "raised"));
    hosts.start_rtm();
    REQUIRE(hosts.says("rtm", "ready"));
    hosts.start_opros();
    CHECK(hosts.exit_code("opros") == 1); // --strict
    CHECK_THAT(
        hosts.output("opros"),
        Contains("port 'raised': an event with content int is 'si' (its id and the content), the peer's type "
                 "IDL:TestAlarm/TimedAlarm:1.0 is '(uu)sd'; use a structure of a string and the content"));
}

TEST_CASE("a name in event_ports that is not a data port of the RTC is reported") {
    AlarmHosts hosts("", "siren");
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "property 'event_ports' names 'siren', which is not a data port of AlarmRtc0"));
    CHECK(hosts.says("opros", "ready"));
    CHECK(hosts.stop_both());
}

namespace {

/// CookComp and OvenRtc, whose state machine takes events through an EventInPort.
struct OvenHosts : TwoHosts {
    explicit OvenHosts(const std::string& connections) {
        set_talker("CookComp");
        set_rtc("OvenRtc");
        set_connections(connections);
    }
};

} // namespace

TEST_CASE(
    "OPRoS events drive the state machine of an RTC by their ids, with and without argument, in order") {
    OvenHosts hosts(TwoHosts::connection("event", "Talker", "button", "Adaptor", "panel"));
    hosts.start_rtm();
    hosts.start_opros();
    INFO(hosts.output("opros") + hosts.output("rtm"));
    // In each round, start has no effect before the minutes are set, and the last of two ticks ends it.
    CHECK(hosts.says(
        "rtm", "oven: idle\noven: 2 minutes, a time\noven: heating\noven: tick\noven: tick\noven: idle\n"));
    CHECK(hosts.says(
        "opros",
        "port 'panel': events with content int are 'i': they can be minutes, start, tick; not label, "
        "since the peer's EventInPort takes label 's', minutes 'i', start, tick"));
    CHECK(hosts.says("opros",
                     "port 'panel': a message cannot cross the link and is dropped, 1 so far: event 'bake' "
                     "without content; the peer's EventInPort takes label 's', minutes 'i', start, tick"));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("ports with contents of several types can send to one EventInPort, even after the RTM host has "
          "returned") {
    OvenHosts hosts(TwoHosts::connection("event", "Talker", "button", "Adaptor", "panel") +
                    TwoHosts::connection("event", "Talker", "label", "Adaptor", "panel"));
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("rtm", "oven: label bread\n"));
    REQUIRE(hosts.says("rtm", "oven: heating\n"));
    const std::size_t killed = hosts.restart_rtm("rtm");
    CHECK(hosts.says("rtm", "oven: label bread\n", killed));
    CHECK(hosts.says("rtm", "oven: heating\n", killed));
    CHECK(hosts.stop_both());
}

TEST_CASE("a property maps the ids of events to those of the RTC's state machine") {
    OvenHosts hosts(TwoHosts::connection("event", "Talker", "button", "Adaptor", "panel"));
    hosts.set_adaptor_property("names.panel", "bake=start, start=none");
    hosts.start_rtm();
    hosts.start_opros();
    INFO(hosts.output("opros") + hosts.output("rtm"));
    CHECK(hosts.says("rtm", "oven: heating\n")); // only bake starts it
    CHECK(hosts.says(
        "opros", "event 'none' without content; the peer's EventInPort takes label 's', minutes 'i', start, "
                 "tick; AdaptorComp's property 'names.panel' can say which of these it is: start=EVENT"));
    CHECK(hosts.stop_both());
    CHECK_THAT(hosts.output("opros"), !Contains("event 'bake'"));
}

TEST_CASE("events that no handler of the RTC's state machine accepts are refused with all signatures") {
    OvenHosts hosts(TwoHosts::connection("event", "Talker", "weight", "Adaptor", "knob"));
    hosts.start_rtm();
    REQUIRE(hosts.says("rtm", "ready"));
    hosts.start_opros();
    CHECK(hosts.exit_code("opros") == 1); // --strict
    CHECK_THAT(
        hosts.output("opros"),
        Contains(
            "port 'knob': events with content double are 'd', the peer's EventInPort takes turn 'i'; use a "
            "content with one of these signatures"));
}
