// SPDX-License-Identifier: Apache-2.0
// `tandem link check`: both sides of a link, with hosts that run or do not.
#include "tests/integration/joined_folder.hpp"
#include "two_hosts.hpp"

#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>

using Catch::Contains;

TEST_CASE("link check prints each port with its peer, both signatures and the conversion") {
    JoinedFolder folder;
    const auto result = folder.tandem({"link", "check", "joined"});
    INFO(result.output);
    CHECK(result.exit_code() == 0);
    CHECK_THAT(
        result.output,
        Contains("link TalkerComp-EchoRtc: EchoRtc0 behind Adaptor, not running (ports from rtc.conf)\n"));
    const auto json = nlohmann::json::parse(folder.tandem({"link", "check", "joined", "--json"}).output);
    REQUIRE(json["connections"].size() == 3);
    const auto connection = [&](const std::string& from) {
        for (const auto& each : json["connections"])
            if (each["from"] == from) return each;
        return nlohmann::json();
    };
    CHECK(connection("TalkerComp.word")["to"] == "EchoRtc0.word");
    CHECK(connection("TalkerComp.word")["from_port"]["signature"] == "s");
    CHECK(connection("TalkerComp.word")["to_port"]["signature"] == "(uu)s");
    CHECK(connection("TalkerComp.word")["conversion"] == "tm is set");
    CHECK(connection("EchoRtc0.reply")["conversion"] == "tm is left out");
    CHECK(connection("TalkerComp.dictionary")["to_port"]["methods"][0]["signature"] ==
          "sad:ai raises IDL:TestDictionary/NotFound:1.0(s)");
    CHECK_THAT(result.output,
               Contains("without a peer: EchoRtc0.picture (data input, '(uu)ay'): no connection in ") &&
                   Contains("without a peer: TalkerComp.numbers (data output, 'ai')"));
}

TEST_CASE("link check fails for a configured connection that cannot be made, and reports the others") {
    JoinedFolder folder;
    folder.edit("joined/opros/joined.xml", "component_name=\"Adaptor\" port_name=\"word\"",
                "component_name=\"Adaptor\" port_name=\"numbers\"");
    const auto result = folder.tandem({"link", "check", "joined"});
    INFO(result.output);
    CHECK(result.exit_code() == 1);
    CHECK_THAT(result.output, Contains(": cannot be connected: type mismatch") &&
                                  Contains("has signature 's'") && Contains("'(uu)ad'"));
    CHECK_THAT(result.output, Contains("EchoRtc0.reply"));
}

TEST_CASE("link check shows the requested conversions, and suggests peers by type") {
    JoinedFolder folder;
    for (const char* component : {"TalkerComp", "Adaptor"})
        folder.edit("joined/opros/joined.xml",
                    std::string("component_name=\"") + component + "\" port_name=\"word\"",
                    std::string("component_name=\"") + component + "\" port_name=\"numbers\"");
    folder.edit("joined/opros/joined.xml", "</properties>",
                "<property name=\"convert.numbers\">widen</property></properties>");
    const auto result = folder.tandem({"link", "check", "joined"});
    INFO(result.output);
    CHECK(result.exit_code() == 0);
    CHECK_THAT(result.output, Contains("TalkerComp.numbers") && Contains(" widen\n"));
    CHECK_THAT(result.output,
               Contains("without a peer: EchoRtc0.word (data input, '(uu)s'): no connection in ") &&
                   Contains(" names it; its type fits TalkerComp.word\n") &&
                   Contains(" names it; its type fits EchoRtc0.word\n"));
    CHECK_THAT(result.output,
               Contains("without a peer: EchoRtc0.picture (data input, '(uu)ay'): no connection in ") &&
                   !Contains("it fits EchoRtc0.picture"));
}

TEST_CASE("link check and link profile name a property of a port that the RTC does not have") {
    JoinedFolder folder;
    folder.edit("joined/opros/joined.xml", "</properties>",
                "<property name=\"names.dictonary\">lookup=find</property></properties>");
    const auto result = folder.tandem({"link", "check", "joined"});
    INFO(result.output);
    CHECK(result.exit_code() == 1);
    const std::string line =
        "property 'names.dictonary': EchoRtc0 has no service port or EventInPort 'dictonary'; it has "
        "dictionary; it counts when the port is added\n";
    CHECK_THAT(result.output, Contains("component 'Adaptor': " + line));
    const auto written = folder.tandem({"link", "profile", "TalkerComp", "EchoRtc", "--property",
                                        "names.dictonary=lookup=find", "--output", "other"});
    CHECK(written.exit_code() == 0);
    CHECK_THAT(written.output, Contains("note: " + line));
}

TEST_CASE("link check names a link that only one side has") {
    JoinedFolder folder;
    folder.edit("joined/rtm/rtc.conf", "link=TalkerComp-EchoRtc", "link=other");
    const auto result = folder.tandem({"link", "check", "joined"});
    INFO(result.output);
    CHECK(result.exit_code() == 1);
    CHECK_THAT(
        result.output,
        Contains("component 'Adaptor' joins link 'TalkerComp-EchoRtc', but no InterceptorComp in rtc.conf "
                 "has this link (links in rtc.conf: other)\n"));
    CHECK_THAT(result.output,
               Contains("InterceptorComp shares EchoRtc0 on link 'other', but no AdaptorComp of the "
                        "application joins it\n"));
}

TEST_CASE("link check reads the running RTM host without disturbing it") {
    JoinedFolder folder;
    TwoHosts hosts;
    hosts.start_rtm();
    REQUIRE(hosts.says("rtm", "ready"));
    folder.edit("joined/opros/joined.xml", ">TalkerComp-EchoRtc<", ">" + hosts.link() + "<");
    std::filesystem::remove(folder.path() / "joined/rtm/rtc.conf");
    const auto result = folder.tandem({"link", "check", "joined"});
    INFO(result.output);
    CHECK(result.exit_code() == 0);
    CHECK_THAT(result.output, Contains("link " + hosts.link() + ": EchoRtc0 behind Adaptor, running\n"));
    CHECK_THAT(hosts.output("rtm"), !Contains("is up"));
    CHECK(hosts.stop("rtm") == 0);
}
