// SPDX-License-Identifier: Apache-2.0
// Ports that components of either model add and remove while the link is up.
#include "changing_hosts.hpp"

#include <catch2/catch.hpp>

TEST_CASE("ports that an RTC adds late are connected until it removes them") {
    ChangingHosts hosts;
    hosts.set_connections(TwoHosts::connection("data", "Adaptor", "steady", "Tally", "steady") +
                          TwoHosts::connection("data", "Tally", "back", "Adaptor", "back") +
                          TwoHosts::connection("data", "Adaptor", "activated", "Tally", "activated") +
                          TwoHosts::connection("data", "Adaptor", "late", "Tally", "late") +
                          TwoHosts::connection("data", "Tally", "lateOut", "Adaptor", "lateIn"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "component 'Adaptor' has no port 'late', its data ports are: back, linkState, "
                              "steady; this connection is left out until the port is added"));
    CHECK(hosts.says("opros", "connection Adaptor.activated -> Tally.activated is made: its port was added"));
    CHECK(hosts.says("opros", "Tally activated "));

    REQUIRE(hosts.sets("LateRtc0", "stage=add"));
    CHECK(hosts.says("rtm", "port 'late' was added to LateRtc0 and is shared"));
    CHECK(hosts.says("opros", "Tally late "));
    // A port that the OPRoS component adds later than the RTC adds its own.
    CHECK(hosts.says("opros", "connection Tally.lateOut -> Adaptor.lateIn is made: its port was added"));
    CHECK(hosts.says("rtm", "LateRtc lateIn 1"));

    REQUIRE(hosts.sets("LateRtc0", "stage=remove"));
    CHECK(hosts.says("rtm",
                     "port 'late' of LateRtc0 was removed: nothing crosses there until it is added again"));
    CHECK(hosts.says("opros", "port Adaptor.late was removed: 1 of its connections end, "));
    CHECK(hosts.says("opros", "port Adaptor.lateIn was removed: 1 of its connections end, "));
    CHECK(hosts.says("opros", "connections end, 2 so far"));

    const auto opros_before = hosts.output("opros").size(), rtm_before = hosts.output("rtm").size();
    REQUIRE(hosts.sets("LateRtc0", "stage=add"));
    CHECK(hosts.says("opros", "Tally late ", opros_before));
    CHECK(hosts.says("rtm", "LateRtc lateIn ", rtm_before));

    CHECK(hosts.is_complete("steady", "rtm"));
    CHECK(hosts.is_complete("back", "opros"));
    CHECK_FALSE(hosts.has_said("opros", "lacks a number"));
    CHECK_FALSE(hosts.has_said("rtm", "lacks a number"));
    CHECK_FALSE(hosts.has_said("opros", "is down"));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("a change of the ports that a composite exports is followed") {
    ChangingHosts hosts;
    hosts.set_interceptor("rtc=Group0");
    hosts.add_built_in_rtc("PeriodicECSharedComposite?instance_name=Group0");
    hosts.append_to_rtc_conf(
        "composite.PeriodicECShared.Group0.conf.default.members: LateRtc0\n"
        "composite.PeriodicECShared.Group0.conf.default.exported_ports: LateRtc0.back\n");
    hosts.set_connections(TwoHosts::connection("data", "Adaptor", "steady", "Tally", "steady") +
                          TwoHosts::connection("data", "Tally", "back", "Adaptor", "back"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "component 'Adaptor' has no port 'steady'"));
    REQUIRE(hosts.sets("Group0", "exported_ports=LateRtc0.back,LateRtc0.steady"));
    CHECK(hosts.says("opros", "connection Adaptor.steady -> Tally.steady is made"));
    CHECK(hosts.is_complete("steady", "rtm"));
    REQUIRE(hosts.sets("Group0", "exported_ports=LateRtc0.back"));
    CHECK(hosts.says("opros", "port Adaptor.steady was removed: 1 of its connections end, 1 so far"));
    CHECK(hosts.is_complete("back", "opros"));
    CHECK_FALSE(hosts.has_said("rtm", "lacks a number"));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("a service port added late is called, and a call after its removal fails without other effects") {
    ChangingHosts hosts;
    hosts.set_rtc("EchoRtc");
    hosts.set_interceptor("rtc=Group0");
    hosts.set_talker("TalkerComp");
    hosts.add_built_in_rtc("PeriodicECSharedComposite?instance_name=Group0");
    hosts.append_to_rtc_conf(
        "composite.PeriodicECShared.Group0.conf.default.members: EchoRtc0\n"
        "composite.PeriodicECShared.Group0.conf.default.exported_ports: EchoRtc0.word,EchoRtc0.reply\n");
    hosts.set_connections(TwoHosts::connection("data", "Talker", "word", "Adaptor", "word") +
                          TwoHosts::connection("data", "Adaptor", "reply", "Talker", "reply") +
                          TwoHosts::connection("service", "Talker", "dictionary", "Adaptor", "dictionary"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "component 'Adaptor' has no port 'dictionary'"));
    for (int round = 0; round < 2; ++round) {
        auto before = hosts.output("opros").size();
        REQUIRE(hosts.sets("Group0", "exported_ports=EchoRtc0.word,EchoRtc0.reply,EchoRtc0.dictionary"));
        CHECK(hosts.says("opros", "connection Talker.dictionary -> Adaptor.dictionary is made", before));
        CHECK(hosts.says("opros", "pages: 2 last 5", before));
        before = hosts.output("opros").size();
        REQUIRE(hosts.sets("Group0", "exported_ports=EchoRtc0.word,EchoRtc0.reply"));
        CHECK(hosts.says("opros", "port Adaptor.dictionary was removed: 1 of its connections end", before));
        CHECK(hosts.says("opros", " is not connected", before));
    }
    CHECK(hosts.is_complete("word", "opros"));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("ports that a shared OPRoS component adds late are shown, and its other ports lose no messages") {
    ChangingHosts hosts;
    hosts.set_interceptor("rtc="); // LateRtc0 is an RTC beside the link
    hosts.set_adaptor_properties(TwoHosts::property("share", "Tally"));
    hosts.set_connections("");
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("rtm", "OPRoS component Tally is shown as an RTC"));
    // The default keeps 8 messages, 80 ms: less than a component may be late on a busy machine.
    const std::string keep_all = "inport.buffer.length=10000";
    REQUIRE(hosts.run({"connect", "Tally:back", "LateRtc0:back", "-p", keep_all}).exit_code == 0);
    REQUIRE(hosts.run({"connect", "LateRtc0:steady", "Tally:steady", "-p", keep_all}).exit_code == 0);
    REQUIRE(hosts.run({"activate", "LateRtc0"}).exit_code == 0);
    const int skipped = hosts.ring("Tally.back")["dropped"]["skipped"]; // sent before somebody was connected
    REQUIRE(hosts.run({"inject", "Tally:late", "5"}).exit_code == 0);
    CHECK(hosts.says("opros", "Tally late 5"));
    CHECK(hosts.says("opros", "Adaptor: port 'Tally.lateOut' was added and is shared"));
    CHECK(hosts.says("rtm", "Tally: port 'Tally.lateIn' was added to the OPRoS component and is shown"));
    CHECK(hosts.run({"inject", "Tally:lateIn", "6"}).exit_code == 0);
    CHECK(hosts.says("opros", "Tally lateIn 6"));
    REQUIRE(hosts.sets("LateRtc0", "stage=add"));
    CHECK(hosts.run({"connect", "Tally:lateOut", "LateRtc0:lateIn"}).exit_code == 0);
    CHECK(hosts.says("rtm", "LateRtc lateIn 1"));
    CHECK(hosts.is_complete("Tally.steady", "rtm"));
    CHECK(hosts.is_complete("Tally.back", "opros", skipped));
    CHECK_FALSE(hosts.has_said("opros", "lacks a number"));
    CHECK_FALSE(hosts.has_said("rtm", "lacks a number"));
    CHECK_FALSE(hosts.has_said("rtm", "is down"));

    // Another process that shares the component has the ports from the start, or when it adds them.
    const auto shown_before = hosts.output("rtm").size();
    hosts.kill("opros");
    REQUIRE(hosts.says("rtm", "is down"));
    const auto before = hosts.output("opros").size();
    hosts.start_opros();
    CHECK(hosts.says("rtm", "is no longer shared with the same ports"));
    const bool is_shown = hosts.says("rtm", "OPRoS component Tally is shown as an RTC", shown_before);
    INFO(hosts.output("rtm").substr(shown_before) + hosts.output("opros").substr(before));
    REQUIRE(is_shown);
    REQUIRE(hosts.run({"inject", "Tally:late", "7"}).exit_code == 0);
    CHECK(hosts.says("opros", "Adaptor: port 'Tally.lateOut' was added and is shared", before));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}
