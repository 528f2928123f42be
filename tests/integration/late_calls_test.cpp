// SPDX-License-Identifier: Apache-2.0
// Event ports and service ports that components of both models add and remove while the link is up.
#include "changing_hosts.hpp"

namespace {

struct GuestHosts : ChangingHosts {
    GuestHosts() {
        set_rtc("GuestRtc");
        set_interceptor("rtc=GuestRtc0");
    }
    /// Returns whether each kind of port now carries something, in each direction.
    void check_all_cross() {
        forget_output();
        CHECK(now_says("opros", "Guest event: answer to hot "));
        CHECK(now_says("opros", "Guest pages: 2"));
        CHECK(now_says("rtm", "guest: 30 pages"));
    }
};

} // namespace

TEST_CASE("event and service ports that both components add late carry events and calls, can be removed, and "
          "can return") {
    GuestHosts hosts;
    hosts.add_component("Guest", "GuestComp", TwoHosts::property("stage", "add"));
    hosts.set_adaptor_properties(TwoHosts::property("event_ports", "raised, answer"));
    hosts.set_connections(TwoHosts::connection("event", "Guest", "alarm", "Adaptor", "raised") +
                          TwoHosts::connection("event", "Adaptor", "answer", "Guest", "notice") +
                          TwoHosts::connection("event", "Guest", "knock", "Adaptor", "door") +
                          TwoHosts::connection("service", "Guest", "dictionary", "Adaptor", "dictionary") +
                          TwoHosts::connection("service", "Adaptor", "books", "Guest", "shelf"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "Guest refused: "));
    for (int round = 0; round < 3; ++round) {
        INFO("round " << round);
        REQUIRE(hosts.sets("GuestRtc0", "stage=add"));
        hosts.check_all_cross();
        CHECK(hosts.now_says("rtm", "guest: knock"));
        CHECK(hosts.now_says("rtm", "guest: wait "));
        hosts.forget_output();
        REQUIRE(hosts.sets("GuestRtc0", "stage=remove"));
        for (const char* port : {"raised", "answer", "door", "dictionary", "books"})
            CHECK(hosts.now_says("opros", "port Adaptor." + std::string(port) +
                                              " was removed: 1 of its connections end"));
        hosts.forget_output();
        CHECK(hosts.now_says("opros", "Guest refused: "));
        REQUIRE(hosts.sets("GuestRtc0", "stage=index"));
        CHECK(hosts.now_says("rtm", "port 'dictionary' of GuestRtc0 was added again and is "
                                    "TestDictionary::Index"));
        CHECK(hosts.now_says("opros", "Guest pages: -2"));
        CHECK(hosts.now_says("rtm", "guest: 30 pages by index"));
        REQUIRE(hosts.sets("GuestRtc0", "stage=remove index"));
    }
    REQUIRE(hosts.sets("GuestRtc0", "stage=add"));
    hosts.check_all_cross();
    const auto before = hosts.restart_rtm("opros");
    CHECK(hosts.says("opros", "port Adaptor.raised was removed", before)); // it adds its ports late
    REQUIRE(hosts.sets("GuestRtc0", "stage=add"));
    hosts.check_all_cross();
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE(
    "late event and service ports of a shared OPRoS component appear at its RTC until it removes them") {
    GuestHosts hosts;
    hosts.set_interceptor("rtc="); // GuestRtc0 is an RTC beside the link
    hosts.add_component("Guest", "GuestComp");
    hosts.set_adaptor_properties(TwoHosts::property("share", "Guest") +
                                 TwoHosts::property("interfaces",
                                                    "Guest.shelf=TestDictionary::Dictionary.books, "
                                                    "Guest.dictionary=TestDictionary::Dictionary"));
    hosts.set_connections("");
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("rtm", "OPRoS component Guest is shown as an RTC"));
    REQUIRE(hosts.sets("GuestRtc0", "stage=add"));
    REQUIRE(hosts.run({"activate", "GuestRtc0"}).exit_code == 0);
    for (int round = 0; round < 3; ++round) {
        INFO("round " << round);
        hosts.forget_output();
        REQUIRE(hosts.sets("Guest", "stage=add"));
        for (const char* port : {"alarm", "notice", "dictionary", "shelf"})
            CHECK(hosts.now_says("rtm", "Guest: port 'Guest." + std::string(port) +
                                            "' was added to the OPRoS component"));
        REQUIRE(hosts.run({"connect", "Guest:alarm", "GuestRtc0:raised"}).exit_code == 0);
        REQUIRE(hosts.run({"connect", "GuestRtc0:answer", "Guest:notice"}).exit_code == 0);
        REQUIRE(hosts.run({"connect", "Guest:dictionary", "GuestRtc0:dictionary"}).exit_code == 0);
        REQUIRE(hosts.run({"connect", "GuestRtc0:books", "Guest:shelf"}).exit_code == 0);
        hosts.check_all_cross();
        hosts.forget_output();
        REQUIRE(hosts.sets("Guest", "stage=remove"));
        CHECK(hosts.now_says("opros", "Guest has removed its ports"));
        for (const char* port : {"alarm", "notice", "dictionary", "shelf"})
            CHECK(hosts.now_says("rtm",
                                 "Guest: port 'Guest." + std::string(port) + "' of the OPRoS component"));
    }
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}
