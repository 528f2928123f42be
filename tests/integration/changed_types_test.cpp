// SPDX-License-Identifier: Apache-2.0
// Ports that come back with another type while the link is up, or with another process.
#include "changing_hosts.hpp"

using Catch::Contains;

namespace {

struct RetypedHosts : ChangingHosts {
    RetypedHosts() {
        set_connections(connection("data", "Adaptor", "steady", "Tally", "steady") +
                        connection("data", "Tally", "back", "Adaptor", "back") +
                        connection("data", "Adaptor", "late", "Tally", "late") +
                        connection("data", "Adaptor", "late", "Tally", "lateDouble") +
                        connection("data", "Tally", "lateOut", "Adaptor", "lateIn") +
                        connection("data", "Tally", "lateOutDouble", "Adaptor", "lateIn"));
    }
    /// The ports of other types have lost nothing, and the link was never down.
    void check_others() const {
        CHECK(is_complete("steady", "rtm"));
        CHECK(is_complete("back", "opros"));
        CHECK_FALSE(has_said("opros", "lacks a number"));
        CHECK_FALSE(has_said("rtm", "lacks a number"));
        CHECK_FALSE(has_said("opros", "is down"));
        CHECK_FALSE(has_said("opros", "does not decode"));
    }
};

} // namespace

TEST_CASE("ports that an RTC adds again with another type are connected if the types match, even after "
          "changing back") {
    RetypedHosts hosts;
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "component 'Adaptor' has no port 'late'"));
    REQUIRE(hosts.sets("LateRtc0", "stage=add"));
    CHECK(hosts.says("opros", "Tally late "));
    CHECK(hosts.says("rtm", "LateRtc lateIn 1"));
    for (int round = 0; round < 3; ++round) {
        hosts.forget_output();
        REQUIRE(hosts.sets("LateRtc0", "stage=double"));
        CHECK(hosts.now_says("rtm", "port 'late' of LateRtc0 was added again and is IDL:RTC/TimedDouble:1.0 "
                                    "'{tm}({sec}u{nsec}u){data}d' now, IDL:RTC/TimedLong:1.0"));
        CHECK(hosts.now_says("opros", "connection Adaptor.late -> Tally.lateDouble is made"));
        CHECK(hosts.now_says("opros", "port 'late': OPRoS type int has signature 'i', the peer's type "
                                      "IDL:RTC/TimedDouble:1.0 has '(uu)d'"));
        CHECK(hosts.now_says("opros", "connection Adaptor.late -> Tally.late is left out"));
        CHECK(hosts.now_says("opros", "connection Tally.lateOut -> Adaptor.lateIn is left out"));
        CHECK(hosts.now_says("opros", "Tally lateDouble "));
        CHECK(hosts.now_says("rtm", "LateRtc lateIn double "));

        hosts.forget_output();
        REQUIRE(hosts.sets("LateRtc0", "stage=add"));
        CHECK(hosts.now_says("opros", "connection Adaptor.late -> Tally.late is made"));
        CHECK(hosts.now_says("opros", "connection Adaptor.late -> Tally.lateDouble is left out"));
        CHECK(hosts.now_says("opros", "Tally late "));
        CHECK(hosts.now_says("rtm", "LateRtc lateIn 1"));
    }
    // Each number that LateRtc has sent as a double ends with .5, each that it has got with .25.
    for (const auto& [host, text] :
         {std::pair("opros", "Tally lateDouble "), std::pair("rtm", "lateIn double ")}) {
        const auto output = hosts.output(host);
        for (auto at = output.find(text); at != std::string::npos; at = output.find(text, at + 1))
            REQUIRE_THAT(output.substr(at, output.find('\n', at) - at),
                         Contains(host == std::string("opros") ? ".500000" : ".250000"));
    }
    hosts.check_others();
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE(
    "an RTM host that returns with ports of other types is joined without a restart of the other host") {
    RetypedHosts hosts;
    hosts.set_rtc_properties("late=add");
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "Tally late "));
    REQUIRE(hosts.says("rtm", "LateRtc lateIn 1"));
    hosts.set_rtc_properties("late=double");
    hosts.forget_output();
    hosts.restart_rtm("opros");
    CHECK(hosts.now_says("opros", "port 'late' of LateRtc0 is IDL:RTC/TimedDouble:1.0"));
    CHECK(hosts.now_says("opros", "connection Adaptor.late -> Tally.late is left out"));
    CHECK(hosts.now_says("opros", "Tally lateDouble "));
    CHECK(hosts.now_says("rtm", "LateRtc lateIn double "));
    CHECK_FALSE(hosts.has_said("opros", "does not decode"));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("ports that an OPRoS component adds again with another type are reconnected, in its host and as an "
          "RTC's") {
    RetypedHosts hosts;
    hosts.add_rtc("LateRtc"); // LateRtc1, beside the link
    hosts.set_adaptor_properties(TwoHosts::property("share", "Tally"));
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("rtm", "OPRoS component Tally is shown as an RTC"));
    REQUIRE(hosts.sets("LateRtc0", "stage=add"));
    REQUIRE(hosts.says("rtm", "LateRtc lateIn 1"));
    REQUIRE(hosts.says("rtm", "Tally: port 'Tally.lateIn' was added to the OPRoS component and is shown"));
    for (int round = 0; round < 2; ++round) {
        INFO("round " << round);
        hosts.forget_output();
        REQUIRE(hosts.sets("Tally", "stage=double"));
        CHECK(hosts.now_says("opros", "connection Tally.lateOut -> Adaptor.lateIn is left out"));
        CHECK(hosts.now_says("opros", "Adaptor: port 'Tally.lateIn' was added and is shared"));
        CHECK(hosts.now_says("rtm",
                             "Tally: port 'Tally.lateIn' was added to the OPRoS component and is shown"));
        CHECK(hosts.now_says("rtm",
                             "Tally: port 'Tally.lateOut' was added to the OPRoS component and is shown"));
        REQUIRE(hosts.sets("LateRtc1", "stage=double"));
        REQUIRE(hosts.run({"connect", "Tally:lateOut", "LateRtc1:lateIn"}).exit_code == 0);
        REQUIRE(hosts.run({"activate", "LateRtc1"}).exit_code == 0);
        CHECK(hosts.now_says("rtm", "LateRtc lateIn double "));
        REQUIRE(hosts.run({"inject", "Tally:lateIn", "6.5"}).exit_code == 0);
        CHECK(hosts.now_says("opros", "Tally changingIn 6.5"));

        hosts.forget_output();
        REQUIRE(hosts.sets("Tally", "stage=int"));
        CHECK(hosts.now_says("opros", "connection Tally.lateOut -> Adaptor.lateIn is made"));
        CHECK(hosts.now_says("rtm", "LateRtc lateIn 1"));
        CHECK(hosts.now_says("rtm",
                             "Tally: port 'Tally.lateIn' was added to the OPRoS component and is shown"));
        REQUIRE(hosts.run({"inject", "Tally:lateIn", "7"}).exit_code == 0);
        CHECK(hosts.now_says("opros", "Tally lateIn 7"));
        REQUIRE(hosts.run({"deactivate", "LateRtc1"}).exit_code == 0);
    }
    hosts.check_others();
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}
