// SPDX-License-Identifier: Apache-2.0
// An AdaptorComp that was built against OPRoS's public API alone.
#include "two_hosts.hpp"

#include <catch2/catch.hpp>
#include <fstream>

namespace {

/// The plugin of these tests before the usual one; with `both`, also the InterceptorComp of the others.
void use_opros_api(TwoHosts& hosts, bool both = false) {
    std::vector<std::string> switches{"--plugin-path", PUBLIC_OPROS_API};
    if (both) switches.insert(switches.end(), {"--plugin-path", PUBLIC_RTM_API});
    hosts.set_switches(switches);
}

bool maps(const TwoHosts& hosts, const std::string& host, const std::string& library) {
    std::ifstream file("/proc/" + std::to_string(hosts.pid(host)) + "/maps");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return text.find(library) != std::string::npos;
}

} // namespace

TEST_CASE("with the OPRoS API alone, data and calls cross, and a killed host is bound again") {
    TwoHosts hosts;
    const bool both = GENERATE(false, true);
    use_opros_api(hosts, both);
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "reply: hello 5 at a time"));
    CHECK(maps(hosts, "opros", PUBLIC_OPROS_API "/AdaptorComp.so"));
    CHECK(maps(hosts, "rtm", PUBLIC_RTM_API "/InterceptorComp.so") == both);
    CHECK(hosts.says("opros", "pages: 2 last 5"));
    CHECK(hosts.says(
        "opros", "refused: service 'dictionary.pages': operation 'pages': IDL:TestDictionary/NotFound:1.0"));
    for (int round = 1; round <= 2; ++round) {
        const auto before = hosts.restart_rtm("opros");
        CHECK(hosts.says("opros", "reply:", before));
        CHECK(hosts.says("opros", "pages: 2 last 5", before));
    }
    hosts.kill("opros");
    const auto before = hosts.output("opros").size();
    hosts.start_opros();
    CHECK(hosts.says("opros", "reply: hello 5 at a time", before));
    CHECK(hosts.says("opros", "pages: 2 last 5", before));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("with the OPRoS API alone, an RTC calls an OPRoS component, whose exception is a failed call") {
    TwoHosts hosts;
    use_opros_api(hosts);
    hosts.set_talker("");
    hosts.set_rtc("ClerkRtc");
    hosts.set_connections(TwoHosts::connection("service", "Adaptor", "books", "Shelf", "dictionary"));
    hosts.add_component("Shelf", "ShelfComp");
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("rtm", "clerk: 2 pages, the last is 5"));
    CHECK(hosts.says("rtm", "clerk: UNKNOWN"));
    CHECK(hosts.stop_both());
}

TEST_CASE("with the OPRoS API alone, events cross as structures of id and content") {
    TwoHosts hosts;
    use_opros_api(hosts);
    hosts.set_talker("AlarmComp");
    hosts.set_rtc("AlarmRtc");
    hosts.set_adaptor_property("event_ports", "raised, answer");
    hosts.set_connections(TwoHosts::connection("event", "Talker", "alarm", "Adaptor", "raised") +
                          TwoHosts::connection("event", "Adaptor", "answer", "Talker", "notice"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "event: answer to hot 1 at a time, 0\n"));
    CHECK(hosts.says("opros", "event: answer to hot 2 at a time, 5\n"));
    const std::size_t killed = hosts.restart_rtm("opros");
    CHECK(hosts.says("opros", "event: answer to hot ", killed));
    CHECK(hosts.stop_both());
}

TEST_CASE("with the OPRoS API alone, events drive the state machine of an RTC") {
    TwoHosts hosts;
    use_opros_api(hosts);
    hosts.set_talker("CookComp");
    hosts.set_rtc("OvenRtc");
    hosts.set_connections(TwoHosts::connection("event", "Talker", "button", "Adaptor", "panel") +
                          TwoHosts::connection("event", "Talker", "label", "Adaptor", "panel"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("rtm", "oven: heating\n"));
    CHECK(hosts.says("rtm", "oven: tick\n"));
    CHECK(hosts.says("rtm", "oven: label bread\n"));
    CHECK(hosts.stop_both());
}

TEST_CASE("with the OPRoS API alone, values of another type are converted as configured") {
    TwoHosts hosts;
    use_opros_api(hosts);
    hosts.set_talker("");
    hosts.set_rtc("RangeRtc");
    hosts.add_component("Range", "RangeComp");
    hosts.set_adaptor_property("convert.number", "narrow");
    hosts.set_adaptor_property("convert.small", "narrow");
    hosts.set_connections(TwoHosts::connection("data", "Adaptor", "number", "Range", "number") +
                          TwoHosts::connection("data", "Range", "small", "Adaptor", "small"));
    hosts.start_rtm();
    hosts.start_opros();
    // Larger numbers do not fit into 16 bits.
    CHECK(hosts.says("opros", "RangeComp number 32767\n"));
    CHECK(hosts.says("rtm", "RangeRtc small 32767\n"));
    CHECK(hosts.says("opros", "port 'small': a message cannot cross the link and is dropped, 1 so far"));
    CHECK(hosts.says("opros", "port 'number': a message of 4 bytes does not decode"));
    CHECK(hosts.stop_both());
}

TEST_CASE("with the OPRoS API alone, classes described in the user's header cross in data and in calls") {
    TwoHosts hosts;
    use_opros_api(hosts);
    hosts.set_strict(false);
    hosts.set_talker("SurveyComp");
    hosts.set_rtc("SurveyRtc");
    std::string connections = TwoHosts::connection("service", "Talker", "surveyor", "Adaptor", "surveyor");
    for (const std::string port : {"mark", "scan", "reading"})
        connections += TwoHosts::connection("data", "Talker", port, "Adaptor", port) +
                       TwoHosts::connection("data", "Adaptor", port + "Back", "Talker", port + "Back");
    hosts.set_connections(connections);
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "mark: door! 2.000 4.000\n"));
    CHECK(hosts.says("opros", "scan: 8 not valid, door! 2.000 4.000, lift! 0.750 8.000\n"));
    // A class that it leaves out is refused.
    CHECK(hosts.says("opros", "port 'reading': OPRoS type "));
    CHECK(hosts.says("opros",
                     "cannot cross the link: this engine gives only its name, and it is none of the known "
                     "numbers, bool, std::string and vectors of these; list it in the file of "
                     "TANDEM_OPROS_TYPES"));
    CHECK(hosts.says("opros", "moved: door 11.00 2.000 lift 9.750 4.000\n"));
    CHECK(hosts.stop_both());
}

TEST_CASE("with the OPRoS API alone, a service without IDL is called as a property describes") {
    TwoHosts hosts;
    const bool is_given = GENERATE(false, true);
    use_opros_api(hosts);
    hosts.set_rtc("UnknownRtc");
    hosts.set_strict(false);
    if (is_given) hosts.set_adaptor_property("operations.dictionary", "pages=sad:ai");
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "reply: hello 5 at a time"));
    CHECK(hosts.says("opros",
                     is_given ? "pages: 2 last 5"
                              : "service port 'dictionary' cannot be called: the peer does not know the IDL "
                                "of interface TestDictionary::Dictionary, and the methods of this engine do "
                                "not tell their types: set property 'operations.dictionary'"));
    CHECK(hosts.stop_both());
}

TEST_CASE("features that need more than the OPRoS API are refused with one line each, and the rest works") {
    TwoHosts hosts;
    use_opros_api(hosts);
    hosts.set_strict(false);
    hosts.add_component("Motor", "MotorComp");
    hosts.set_adaptor_property("share", "Motor");
    hosts.set_connections(TwoHosts::connection("data", "Talker", "word", "Adaptor", "word") +
                          TwoHosts::connection("data", "Adaptor", "reply", "Talker", "reply") +
                          TwoHosts::connection("data", "Talker", "word", "Adaptor", "numbers"));
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "property 'share' names Motor: this engine does not let one component find "
                              "another; they are not shown as RTCs"));
    CHECK(hosts.says("opros", "port 'numbers': OPRoS type std::string has signature 's', the peer's type"));
    CHECK(hosts.says("opros", "reply: hello 5 at a time"));
    CHECK(hosts.stop_both());
}
