// SPDX-License-Identifier: Apache-2.0
// Several RTCs behind one link.
#include "two_hosts.hpp"

#include <catch2/catch.hpp>

TEST_CASE("ports of several RTCs are prefixed with the name of their RTC if names clash") {
    TwoHosts hosts;
    hosts.add_rtc("EchoRtc");
    hosts.add_rtc("ServoRtc");
    hosts.set_interceptor("rtc=EchoRtc0;EchoRtc1;ServoRtc0");
    hosts.set_connections(
        TwoHosts::connection("data", "Talker", "word", "Adaptor", "EchoRtc1.word") +
        TwoHosts::connection("data", "Adaptor", "EchoRtc1.reply", "Talker", "reply") +
        TwoHosts::connection("service", "Talker", "dictionary", "Adaptor", "EchoRtc0.dictionary") +
        TwoHosts::connection("data", "Adaptor", "out", "Motor", "speed"));
    hosts.add_component("Motor", "MotorComp");
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("rtm", "sharing 14 ports of EchoRtc0, EchoRtc1, ServoRtc0 on link"));
    CHECK(hosts.says("opros", "reply: hello 5 "));
    CHECK(hosts.says("opros", "pages: 2 last 5"));
    CHECK(hosts.says("opros", "Motor torque 2.")); // the port of the only RTC that has one of this name
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("messages of several senders reach several receivers of both sides once and in order") {
    TwoHosts hosts;
    hosts.leave_out_talker_and_rtc();
    hosts.set_rtc("SwarmRtc");
    hosts.add_rtc("SwarmRtc");
    hosts.append_to_rtc_conf("test.SwarmRtc.port.inport.in.buffer.length: 1000\n"); // all messages have room
    hosts.set_interceptor("rtc=SwarmRtc0;SwarmRtc1");
    std::string connections;
    for (const std::string component : {"First", "Second"}) {
        hosts.add_component(component, "SwarmComp",
                            TwoHosts::property("number", component == "First" ? "1" : "2"));
        for (const std::string rtc : {"SwarmRtc0", "SwarmRtc1"})
            connections += TwoHosts::connection("data", component, "out", "Adaptor", rtc + ".in") +
                           TwoHosts::connection("data", "Adaptor", rtc + ".out", component, "in");
    }
    hosts.set_connections(connections);
    hosts.start_rtm();
    hosts.start_opros();
    for (const char* number : {"1", "2"})
        CHECK(hosts.says("opros", std::string("swarm ") + number + ": all have come"));
    INFO(hosts.output("opros"));
    CHECK(hosts.output("opros").find("is followed by") == std::string::npos);
    CHECK(hosts.stop_both());
}

TEST_CASE("an error of one of several RTCs is named") {
    TwoHosts hosts;
    hosts.set_rtc("ServoRtc");
    hosts.add_rtc("ServoRtc");
    hosts.append_to_rtc_conf("test.ServoRtc1.conf.default.fails: 1\n");
    hosts.set_interceptor("rtc=ServoRtc0;ServoRtc1");
    hosts.set_connections("");
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "Adaptor: RTC 'ServoRtc1' went to ERROR"));
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("two pairs of hosts with two links each share their RTCs at the same time") {
    TwoHosts pairs[2];
    for (auto& hosts : pairs) {
        hosts.add_rtc("ServoRtc");
        hosts.add_link("Second", "ServoRtc0");
        hosts.add_component("Motor", "MotorComp");
        hosts.set_connections(TwoHosts::connection("data", "Talker", "word", "Adaptor", "word") +
                              TwoHosts::connection("data", "Adaptor", "reply", "Talker", "reply") +
                              TwoHosts::connection("data", "Second", "out", "Motor", "speed"));
        hosts.start_rtm();
        hosts.start_opros();
    }
    for (auto& hosts : pairs) {
        CHECK(hosts.says("opros", "reply: hello 5 "));
        CHECK(hosts.says("opros", "Motor torque 2."));
    }
    pairs[0].kill("rtm");
    CHECK(pairs[0].says("opros", "link '" + pairs[0].link() + "' is down"));
    CHECK(pairs[0].says("opros", "link '" + pairs[0].link() + "-2' is down"));
    const auto before = pairs[1].output("opros").size();
    CHECK(pairs[1].says("opros", "Motor torque 2.", before)); // the other pair continues
    CHECK(pairs[0].stop("opros") == 0);
    CHECK(pairs[1].stop_both());
    for (const auto& hosts : pairs) CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("a port that an RTC removes and adds again carries data again, and a new port is shared") {
    TwoHosts hosts;
    hosts.leave_out_talker_and_rtc();
    hosts.set_rtc("ShiftRtc");
    hosts.add_component("Motor", "MotorComp");
    hosts.set_connections(TwoHosts::connection("data", "Adaptor", "number", "Motor", "speed"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "Motor torque 80.")); // twice the number of the cycle
    CHECK(hosts.says(
        "rtm", "port 'number' of ShiftRtc0 was removed: nothing crosses there until it is added again"));
    CHECK(hosts.says("rtm", "port 'extra' was added to ShiftRtc0 and is shared"));
    CHECK(hosts.says("opros", "port Adaptor.number was removed: 1 of its connections end, 1 so far"));
    CHECK(hosts.says("opros", "connection Adaptor.number -> Motor.speed is made: its port was added"));
    CHECK(hosts.says("rtm", "port 'number' of ShiftRtc0 is available again"));
    CHECK(hosts.says("opros", "Motor torque 200."));
    CHECK(hosts.output("opros").find("Motor torque 120.") ==
          std::string::npos); // of a cycle without the port
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}
