// SPDX-License-Identifier: Apache-2.0
// OPRoS components that manage and connect RTCs.
#include "two_hosts.hpp"

#include <catch2/catch.hpp>

namespace {

/// A Boss whose two ports are connected with AdaptorComp.
void add_boss(TwoHosts& hosts, const std::string& manager, const std::string& more_properties = "") {
    hosts.leave_out_talker_and_rtc();
    hosts.set_interceptor("manage=yes");
    hosts.add_component("Boss", "BossComp",
                        TwoHosts::property("manager", manager) + TwoHosts::property("module", "ServoRtc.so") +
                            more_properties);
    hosts.set_connections(TwoHosts::connection("service", "Boss", "manager", "Adaptor", "RtcManager") +
                          TwoHosts::connection("service", "Boss", "connector", "Adaptor", "RtcConnector"));
}

} // namespace

TEST_CASE(
    "an OPRoS component creates, connects and drives RTCs of the host behind the link and of another one") {
    TwoHosts hosts;
    const bool remote = GENERATE(false, true);
    const std::string port = unused_port(), at = remote ? "rtcloc://127.0.0.1:" + port + "/" : "";
    CAPTURE(remote);
    add_boss(hosts, remote ? "127.0.0.1:" + port : "");
    if (remote) hosts.start_another_rtm(port, "manager.components.precreate:\n");
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "boss is done"));
    const auto said = hosts.output("opros");
    INFO(said);
    const auto says = [&](const std::string& line) { return said.find(line) != std::string::npos; };
    CHECK(says("created: " + at + "ServoRtc0 " + at + "ServoRtc1\n"));
    CHECK(says("all: " + std::string(remote ? "" : "EchoRtc0 InterceptorComp0 ") + at + "ServoRtc0 " + at +
               "ServoRtc1\n"));
    CHECK(says(at + "ServoRtc0: configuration set default has no parameter gian; it has "));
    CHECK(says("connections: ServoRtc1.in\n"));
    CHECK(says("there is no port '" + at + "ServoRtc1.nothing'"));
    CHECK(says(at + "ServoRtc0 is ACTIVE\n"));
    CHECK(says(at + "ServoRtc1 is not activated, it is ERROR: the answer is PRECONDITION_NOT_MET\n"));
    CHECK(says(at + "ServoRtc1 is INACTIVE\n"));
    CHECK(says(at + "ServoRtc0 is INACTIVE\n"));
    CHECK(says(at + "ServoRtc0.out is not connected with " + at + "ServoRtc1.in\n"));
    CHECK(says("there is no RTC '" + at + "ServoRtc1'; give Name0, rtcname://"));
    CHECK(says(remote ? "component NoSuchRtc is not created; its log says why\n"
                      : "there is no component type NoSuchRtc"));
    CHECK(says("nobody: service 'RtcManager.list': there is no RTM manager at '127.0.0.1:1' (TRANSIENT)\n"));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("InterceptorComp that its own link exits leaves the other RTCs and their host running") {
    TwoHosts hosts;
    add_boss(hosts, "", TwoHosts::property("exits", "InterceptorComp0"));
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "exits: InterceptorComp0\n"));
    CHECK(hosts.says("opros", "link '" + hosts.link() + "' is down"));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0); // it has not crashed
}

TEST_CASE("without manage=yes no OPRoS component can load code into the RTM host") {
    TwoHosts hosts;
    add_boss(hosts, "");
    hosts.set_interceptor("manage=no");
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "component 'Adaptor' has no port 'RtcManager'"));
    CHECK(hosts.exit_code("opros") == 1);
    CHECK(hosts.stop("rtm") == 0);
}
