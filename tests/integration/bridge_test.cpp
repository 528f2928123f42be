// SPDX-License-Identifier: Apache-2.0
#include "tests/apps/tandem/program.hpp"
#include "two_hosts.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <csignal>
#include <sched.h>

TEST_CASE("strings and calls cross between components that do not know each other") {
    TwoHosts hosts;
    const bool opros_first = GENERATE(true, false);
    opros_first ? hosts.start_opros() : hosts.start_rtm();
    opros_first ? hosts.start_rtm() : hosts.start_opros();

    // The time that TimedString needs was put in on the way.
    CHECK(hosts.says("opros", "reply: hello 5 at a time"));
    CHECK(hosts.says("opros", "pages: 2 last 5"));
    // The provider's exception arrives as one, with its name.
    CHECK(hosts.says(
        "opros", "refused: service 'dictionary.pages': operation 'pages': IDL:TestDictionary/NotFound:1.0"));

    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("an RTC's listeners get each message even if the RTC never reads and its context never ticks") {
    TwoHosts hosts;
    hosts.set_rtc("ListenRtc");
    hosts.set_rtc_properties("execution_contexts=SynchExtTriggerEC&port.inport.word.buffer.length=3");
    hosts.set_connections(TwoHosts::connection("data", "Talker", "word", "Adaptor", "word"));
    hosts.start_rtm();
    hosts.start_opros();
    // The first listener is called before the message is stored, the other one after it.
    CHECK(hosts.says("rtm", "heard: hello 5 at a time, stored before: 4\n"));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.says("rtm", "kept: 3\n")); // of the InPort's own buffer
    const auto before = hosts.output("rtm").size();
    hosts.start_opros();
    CHECK(hosts.says("rtm", "heard: hello 5 at a time", before));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("an RTC's listener that throws loses only its message") {
    TwoHosts hosts;
    hosts.set_rtc("ListenRtc");
    hosts.set_rtc_properties("throws=yes");
    hosts.set_connections(TwoHosts::connection("data", "Talker", "word", "Adaptor", "word"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("rtm", "heard: hello 5 at a time, stored before: 0\n"));
    CHECK(hosts.says(
        "rtm",
        "port 'InterceptorComp0.word': a listener of the RTC's InPort threw CORBA exception BAD_PARAM when a "
        "message came (1 so far)"));
    CHECK(hosts.stop_both());
}

TEST_CASE("calls cross in every wait mode") {
    TwoHosts hosts;
    const std::string mode = GENERATE("spin", "spin-then-futex", "futex", "same-core");
    CAPTURE(mode);
    hosts.set_switches({"--wait-mode", mode, "--cpu", std::to_string(sched_getcpu())});
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "pages: 2 last 5"));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("a killed and restarted host is bound again, and nothing is left in shared memory") {
    TwoHosts hosts;
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "reply: hello 5 "));
    for (int round = 1; round <= 2; ++round) {
        const auto before = hosts.restart_rtm("opros");
        CHECK(hosts.says("opros", "reply:", before));
    }
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("each host says its model in the port table that it shares") {
    TwoHosts hosts;
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "reply: hello 5 "));
    const auto json = tandem::test::tandem_program({"graph", hosts.link(), "--json"}).json();
    for (const auto& [side, host] : json["links"][0]["sides"].items())
        CHECK(host["model"] == (host["program"] == "opros_host" ? "OPRoS" : "RTM"));
    CHECK(hosts.stop_both());
}

TEST_CASE(
    "an RTM host replaced by one with other ports is reported, and the link recovers when the ports return") {
    TwoHosts hosts;
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "reply: hello 5 "));
    hosts.kill("rtm");
    auto before = hosts.output("opros").size();
    hosts.set_rtc("ServoRtc");
    hosts.start_rtm();
    for (const char* port : {"word", "reply", "dictionary"})
        CHECK(hosts.says(
            "opros", std::string("port Adaptor.") + port + " was removed: 1 of its connections end", before));
    CHECK(hosts.says("opros", "Adaptor: link '" + hosts.link() + "' is up again", before));
    hosts.kill("rtm");
    before = hosts.output("opros").size();
    hosts.set_rtc("EchoRtc");
    hosts.start_rtm();
    CHECK(hosts.says("opros", "reply: hello", before));
    CHECK(hosts.says("opros", "pages: 2 last 5", before));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("a segment truncated under running hosts is named by both, and they join a new one") {
    TwoHosts hosts;
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "reply: hello 5 "));
    const auto segments = hosts.segments();
    REQUIRE(segments.size() == 1);
    std::filesystem::resize_file(segments[0], 0);
    for (const auto* host : {"opros", "rtm"})
        CHECK(hosts.says(host, segments[0].string() + " was truncated by another process"));
    REQUIRE(hosts.says("opros", "' is up again"));
    const auto before = hosts.output("opros").size();
    CHECK(hosts.says("opros", "reply:", before));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("a port with a different type is connected if a property of AdaptorComp says how, and policies are "
          "used") {
    TwoHosts hosts;
    hosts.set_adaptor_property("convert.numbers", "widen");
    hosts.set_adaptor_property("keep_last", "1");
    hosts.set_adaptor_property("deadline_ms.reply", "60000");
    hosts.set_connections(TwoHosts::connection("data", "Talker", "numbers", "Adaptor", "numbers") +
                          TwoHosts::connection("data", "Talker", "word", "Adaptor", "word") +
                          TwoHosts::connection("data", "Adaptor", "reply", "Talker", "reply"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "reply: hello 5 at a time"));
    CHECK_THAT(hosts.output("opros"), !Catch::Contains("error") && !Catch::Contains("warning"));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
}
