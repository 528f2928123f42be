// SPDX-License-Identifier: Apache-2.0
#include "two_hosts.hpp"

#include <catch2/catch.hpp>

TEST_CASE("user-defined classes cross to structures with the same members and back, however they serialize") {
    TwoHosts hosts;
    hosts.set_talker("SurveyComp");
    hosts.set_rtc("SurveyRtc");
    std::string connections = TwoHosts::connection("service", "Talker", "surveyor", "Adaptor", "surveyor");
    for (const std::string port : {"mark", "scan", "reading"})
        connections += TwoHosts::connection("data", "Talker", port, "Adaptor", port) +
                       TwoHosts::connection("data", "Adaptor", port + "Back", "Talker", port + "Back");
    hosts.set_connections(connections);
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "mark: door! 2.000 4.000\n"));                                 // save, load
    CHECK(hosts.says("opros", "scan: 8 not valid, door! 2.000 4.000, lift! 0.750 8.000\n")); // save_this
    CHECK(hosts.says("opros", "reading: 4 1 2.5 0.5\n"));                                    // serialize
    CHECK(hosts.says("opros", "moved: door 11.00 2.000 lift 9.750 4.000\n"));                // in a call
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
    CHECK_FALSE(hosts.left_in_shared_memory());
}
