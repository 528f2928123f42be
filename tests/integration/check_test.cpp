// SPDX-License-Identifier: Apache-2.0
// `tandem opros check` of an application with an AdaptorComp, whose ports are those of the RTC behind its link.
#include "two_hosts.hpp"

#include <catch2/catch.hpp>

using Catch::Contains;

TEST_CASE("check reads the ports of an AdaptorComp from the running RTM host without disturbing it") {
    TwoHosts hosts;
    hosts.start_rtm();
    REQUIRE(hosts.says("rtm", "ready"));
    const auto [code, text] = hosts.check_application();
    CHECK(code == 0);
    CHECK(text == "app: 2 components and 3 connections fit\n");

    hosts.set_connections(TwoHosts::connection("data", "Talker", "numbers", "Adaptor", "numbers") +
                          TwoHosts::connection("data", "Talker", "word", "Adaptor", "wort"));
    const auto [code_of_errors, errors] = hosts.check_application();
    CHECK(code_of_errors == 1);
    CHECK_THAT(errors,
               Contains("'ai'") && Contains("'(uu)ad'") && Contains("'wort'") && Contains("app: 2 errors\n"));
    CHECK_THAT(hosts.output("rtm"), !Contains("is up"));
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("check reports the connections that cannot be checked while the RTM host is not running") {
    TwoHosts hosts;
    const auto [code, text] = hosts.check_application();
    CHECK(code == 0);
    CHECK_THAT(
        text,
        Contains(
            "connections of component 'Adaptor' cannot be checked: its ports are those of the RTC on link '" +
            hosts.link() +
            "', which no running RTM host shares; start the RTM host and check again, or give its "
            "configuration with --rtc-conf FILE\n") &&
            Contains("app: 2 components and 0 connections fit; 3 connections not checked\n"));
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("check finds the ports of an AdaptorComp in the rtc.conf while the RTM host is not running") {
    TwoHosts hosts;
    hosts.write_rtc_conf();
    const auto rtc_conf = (hosts.folder() / "rtc.conf").string();
    const auto [code, text] = hosts.check_application({"--rtc-conf", rtc_conf});
    CHECK(code == 0);
    CHECK(text == "app: 2 components and 3 connections fit\n");

    hosts.set_connections(TwoHosts::connection("data", "Talker", "numbers", "Adaptor", "numbers") +
                          TwoHosts::connection("data", "Talker", "word", "Adaptor", "wort"));
    const auto [code_of_errors, errors] = hosts.check_application({"--rtc-conf", rtc_conf});
    CHECK(code_of_errors == 1);
    CHECK_THAT(errors,
               Contains("'ai'") && Contains("'(uu)ad'") && Contains("'wort'") && Contains("app: 2 errors\n"));
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("check reports errors in an rtc.conf") {
    TwoHosts hosts;
    hosts.append_to_rtc_conf("manager.components.precreate: NoSuchRtc\n");
    hosts.write_rtc_conf();
    const auto [code, text] = hosts.check_application({"--rtc-conf", (hosts.folder() / "rtc.conf").string()});
    CHECK(code == 1);
    CHECK_THAT(text,
               Contains("rtc.conf: manager.components.precreate: there is no component type NoSuchRtc"));
}

TEST_CASE("two hosts stopped at the same time end normally and without an error") {
    for (int round = 0; round < 5; ++round) {
        TwoHosts hosts;
        hosts.start_rtm();
        hosts.start_opros();
        REQUIRE(hosts.says("opros", "reply: hello 5 "));
        CHECK(hosts.stop_both());
        for (const auto* host : {"opros", "rtm"}) {
            INFO(hosts.output(host));
            CHECK_THAT(hosts.output(host), !Contains("failed") && !Contains("error"));
        }
        CHECK_FALSE(hosts.left_in_shared_memory());
    }
}
