// SPDX-License-Identifier: Apache-2.0
// Unfit input is refused at set-up: one line with the fault, the place and the remedy, and a non-zero exit
// code.
#include "two_hosts.hpp"

#include <catch2/catch.hpp>

#include <csignal>
#include <unistd.h>

namespace {
void check_refused(TwoHosts& hosts, const std::string& host, const std::vector<std::string>& parts) {
    CHECK(hosts.exit_code(host) == 1);
    for (const auto& part : parts) CHECK_THAT(hosts.output(host), Catch::Contains(part));
    CHECK_THAT(hosts.output(host), !Catch::Contains("ready"));
}
} // namespace

TEST_CASE("ports of types that do not fit are refused with both signatures") {
    TwoHosts hosts;
    hosts.set_connections(TwoHosts::connection("data", "Talker", "numbers", "Adaptor", "numbers"));
    hosts.start_rtm();
    hosts.start_opros();
    check_refused(hosts, "opros", {"app.xml:", "'ai'", "'(uu)ad'", "IDL:RTC/TimedDoubleSeq:1.0"});
    CHECK(hosts.stop("rtm") == 0);
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE(
    "a connection that is refused leaves all others working, and the line says which member and what to do") {
    TwoHosts hosts;
    hosts.set_strict(false);
    hosts.set_connections(TwoHosts::connection("data", "Talker", "numbers", "Adaptor", "numbers") +
                          TwoHosts::connection("data", "Talker", "word", "Adaptor", "word") +
                          TwoHosts::connection("data", "Adaptor", "reply", "Talker", "reply") +
                          TwoHosts::connection("service", "Talker", "dictionary", "Adaptor", "dictionary"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "reply: hello 5 at a time"));
    CHECK(hosts.says("opros", "pages: 2 last 5"));
    const auto output = hosts.output("opros");
    for (const char* part :
         {"output Talker.numbers is std::vector<int>", "'ai'", "'(uu)ad'",
          "field 'data[]' is int32 here, double there: ask for widen", "this connection is left out"})
        CHECK_THAT(output, Catch::Contains(part));
    CHECK_THAT(output, !Catch::Contains("cannot activate"));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("a strict AdaptorComp goes to its error state when a connection is refused") {
    TwoHosts hosts;
    hosts.set_strict(false);
    hosts.set_adaptor_property("strict", "1");
    hosts.set_connections(TwoHosts::connection("data", "Talker", "numbers", "Adaptor", "numbers"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "strict: port 'numbers': OPRoS type std::vector<int>"));
    CHECK_THAT(hosts.output("opros"), !Catch::Contains("activated"));
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("a port that the peer does not have is named together with the peer's ports") {
    TwoHosts hosts;
    hosts.set_connections(TwoHosts::connection("data", "Talker", "word", "Adaptor", "wort"));
    hosts.start_rtm();
    hosts.start_opros();
    check_refused(hosts, "opros", {"app.xml:", "'wort'", "numbers", "word"});
}

TEST_CASE("a host whose peer never joins gives up and names the peer") {
    TwoHosts hosts;
    hosts.set_wait("0.2");
    hosts.start_opros();
    check_refused(hosts, "opros", {hosts.link(), "InterceptorComp", "did not join within 0.2 s"});
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("a missing RTC in the list of shared RTCs is named") {
    TwoHosts hosts;
    hosts.set_interceptor("rtc=Nobody0");
    hosts.start_rtm();
    check_refused(hosts, "rtm", {"Nobody0", "manager.components.precreate"});
}

TEST_CASE("too little shared memory is an error that names the needed and the available size") {
    TwoHosts hosts;
    hosts.set_interceptor("rtc=EchoRtc0&segment_mib=900000");
    hosts.start_rtm();
    check_refused(hosts, "rtm", {"/dev/shm/", "bytes needed", "available"});
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("an invalid wait mode is refused by both hosts, and by the bridge in any other engine") {
    TwoHosts hosts;
    hosts.set_switches({"--wait-mode", "same-core"});
    hosts.start_rtm();
    hosts.start_opros();
    for (const auto* host : {"rtm", "opros"}) check_refused(hosts, host, {"needs --cpu N"});
    setenv("TANDEM_WAIT_MODE", "sleepy", 1);
    TwoHosts others;
    others.start_rtm();
    others.start_opros();
    unsetenv("TANDEM_WAIT_MODE");
    for (const auto* host : {"rtm", "opros"})
        check_refused(others, host,
                      {"TANDEM_WAIT_MODE is 'sleepy'", "expected spin, spin-then-futex, futex or same-core"});
}

TEST_CASE("a link name in use by a living process is refused") {
    TwoHosts hosts, others;
    hosts.start_rtm();
    REQUIRE(hosts.says("rtm", "ready"));
    others.set_interceptor("rtc=EchoRtc0&link=" + hosts.link());
    others.start_rtm();
    check_refused(others, "rtm", {hosts.link(), "is held by a living process"});
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("an unknown parameter of InterceptorComp is named, and prevents its creation with strict") {
    for (const bool strict : {false, true}) {
        TwoHosts hosts;
        hosts.set_interceptor(std::string("rtc=EchoRtc0&wait_sm=100&strict=") + (strict ? "1" : "0"));
        hosts.start_rtm();
        CHECK(hosts.says("rtm",
                         "InterceptorComp0: parameter 'wait_sm' is not one of InterceptorComp's and has no "
                         "effect; it has link, rtc, "));
        if (strict)
            CHECK(hosts.exit_code("rtm") == 1);
        else
            CHECK((hosts.says("rtm", "sharing ") && hosts.stop("rtm") == 0));
    }
}
