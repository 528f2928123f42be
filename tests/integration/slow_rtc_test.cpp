// SPDX-License-Identifier: Apache-2.0
// An RTC behind the bridge whose device needs its time.
#include "two_hosts.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

#include <fstream>

namespace {

/// Behind one link EchoRtc0 and three HangRtcs, of which the first and the last one hang until release().
struct HangingRtcs : TwoHosts {
    explicit HangingRtcs(const std::string& interceptor = "", const std::string& callback = "onDeactivated") {
        for (int i = 0; i < 3; ++i) add_rtc("HangRtc");
        for (const std::string number : {"0", "2"})
            append_to_rtc_conf("test.HangRtc" + number + ".until: " + release_file().string() +
                               "\ntest.HangRtc" + number + ".in: " + callback + "\n");
        set_interceptor("rtc=HangRtc0;EchoRtc0;HangRtc1;HangRtc2" + interceptor);
        start_rtm();
        start_opros();
        if (!says("opros", "reply: hello 5 ")) throw std::runtime_error("nothing crosses");
    }
    std::filesystem::path release_file() const { return folder() / "release"; }
    void release() const { std::ofstream(release_file()) << "now"; }
    bool has_said(const std::string& host, const std::string& text, std::size_t from) const {
        return output(host).find(text, from) != std::string::npos;
    }
};

} // namespace

TEST_CASE("the link waits for an RTC that is slow to activate and to deactivate") {
    TwoHosts hosts;
    hosts.set_rtc_properties("slow_ms=2500"); // longer than call_timeout, and than its context waits
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "onStart of component Adaptor has taken 2 s so far"));
    CHECK(hosts.says("opros", "reply: hello 5 "));
    CHECK(hosts.stop("opros") == 0);
    CHECK_THAT(hosts.output("opros"), !Catch::Contains("failed"));
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("an RTC behind a link is reactivated while others still hang in onDeactivated, and these when they "
          "return") {
    HangingRtcs hosts("&call_timeout=300000"); // how long a deactivation may take
    hosts.kill("opros");
    for (const char* rtc : {"HangRtc2", "HangRtc0"}) // neither waits for the other one
        CHECK(hosts.says("rtm", std::string(rtc) + " deactivating"));
    const auto before_rtm = hosts.output("rtm").size(), before_opros = hosts.output("opros").size();
    hosts.start_opros();
    CHECK(hosts.says("rtm", "HangRtc1 activated", before_rtm));
    for (const char* rtc : {"HangRtc2", "HangRtc0"})
        CHECK_FALSE(hosts.has_said("rtm", std::string(rtc) + " deactivated", before_rtm));
    hosts.release();
    for (const char* rtc : {"HangRtc2", "HangRtc0"})
        CHECK(hosts.says("rtm", std::string(rtc) + " activated", before_rtm));
    CHECK(hosts.says("opros", "reply: hello", before_opros));
    CHECK(hosts.stop_both());
}

TEST_CASE("an RTC that hangs too long in onDeactivated is named, and is reactivated when it returns") {
    HangingRtcs hosts;
    hosts.kill("opros");
    REQUIRE(hosts.says("rtm", "HangRtc0 deactivating"));
    const auto before_rtm = hosts.output("rtm").size(), before_opros = hosts.output("opros").size();
    hosts.start_opros();
    for (const std::string rtc : {"HangRtc2", "HangRtc0"}) {
        CHECK(hosts.says("rtm",
                         rtc + " is still ACTIVE and was not deactivated within 5000 ms: its onDeactivated "
                               "is slow or hangs"));
        CHECK(hosts.says(
            "rtm", rtc + " is still deactivating; it is activated when its onDeactivated has returned"));
    }
    CHECK(hosts.says("opros", "reply: hello", before_opros)); // the link continues without them
    for (const std::string rtc : {"HangRtc2", "HangRtc0"})
        CHECK_FALSE(hosts.has_said("rtm", rtc + " deactivated", before_rtm));
    hosts.release();
    for (const std::string rtc : {"HangRtc2", "HangRtc0"}) {
        CHECK(hosts.says("rtm", rtc + " activated", before_rtm));
        CHECK(hosts.says("rtm", rtc + " is active again: its onDeactivated has returned"));
    }
    CHECK(hosts.stop_both());
}

TEST_CASE("an RTC whose onExecute does not return when it is to stop is named with onExecute") {
    HangingRtcs hosts("", "onExecute");
    hosts.kill("opros");
    for (const std::string rtc : {"HangRtc2", "HangRtc0"})
        CHECK(hosts.says(
            "rtm", rtc + " is still ACTIVE and was not deactivated within 5000 ms: its onExecute is slow or "
                         "hangs"));
    hosts.release();
    const auto before_opros = hosts.output("opros").size();
    hosts.start_opros();
    CHECK(hosts.says("opros", "reply: hello", before_opros));
    CHECK(hosts.stop_both());
}
