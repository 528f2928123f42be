// SPDX-License-Identifier: Apache-2.0
// `tandem doctor DIR`: what would keep an application from running, before it starts.
#include "shm/segment.hpp"
#include "tests/integration/joined_folder.hpp"

#include <nlohmann/json.hpp>
#include <unistd.h>

#include <filesystem>
#include <vector>

using Catch::Contains;
using Json = nlohmann::json;

namespace {

/// The application's checks of that name; those of the machine have others.
std::vector<Json> checks_of(const ScratchFolder& folder, const std::string& name) {
    const auto result = folder.tandem({"doctor", "joined", "--json"});
    INFO(result.output);
    std::vector<Json> found;
    bool error = false;
    const Json report = Json::parse(result.output);
    for (const auto& check : report["checks"]) {
        error = error || check["status"] == "error";
        if (check["name"] == name) found.push_back(check);
    }
    CHECK(result.exit_code() == (error ? 1 : 0));
    return found;
}

/// Returns the advice of the only check of that name, which must be an error.
std::string advice_of(const ScratchFolder& folder, const std::string& name) {
    const auto checks = checks_of(folder, name);
    REQUIRE(checks.size() == 1);
    CHECK(checks[0]["status"] == "error");
    return checks[0].value("advice", "");
}

const std::string application = "OPRoS application";

} // namespace

TEST_CASE("doctor finds nothing wrong with an application that runs") {
    const JoinedFolder folder;
    const auto fits = checks_of(folder, application);
    REQUIRE(fits.size() == 1);
    CHECK(fits[0]["status"] == "ok");
    CHECK(fits[0]["value"] == "2 components and 3 connections fit");
    const auto rtcs = checks_of(folder, "RTCs");
    REQUIRE(rtcs.size() == 1);
    CHECK(rtcs[0]["value"] == "EchoRtc0");
    const auto link = checks_of(folder, "link TalkerComp-EchoRtc");
    REQUIRE(link.size() == 1);
    CHECK(link[0]["status"] == "ok");
    CHECK_THAT(folder.tandem({"doctor", "joined"}).output, Contains("2 components and 3 connections fit"));
}

TEST_CASE(
    "doctor reports before the start which connection will be refused and which link has one end only") {
    const JoinedFolder folder;
    folder.edit("joined/opros/joined.xml", "component_name=\"Adaptor\" port_name=\"word\"",
                "component_name=\"Adaptor\" port_name=\"numbers\"");
    CHECK_THAT(advice_of(folder, application),
               Contains("joined.xml:") && Contains("has signature 's'") && Contains("'(uu)ad'"));
    folder.edit("joined/rtm/rtc.conf", "link=TalkerComp-EchoRtc", "link=other");
    CHECK_THAT(advice_of(folder, application), Contains("has no InterceptorComp with this link"));
}

TEST_CASE("doctor reports before the start that a library or the folder is missing") {
    const JoinedFolder folder;
    std::filesystem::remove(folder.path() / "TalkerComp/TalkerComp.so");
    CHECK_THAT(advice_of(folder, application), Contains("TalkerComp"));
    std::filesystem::remove(folder.path() / "EchoRtc/EchoRtc.so");
    CHECK_THAT(advice_of(folder, "RTCs"), Contains("EchoRtc"));
    std::filesystem::remove_all(folder.path() / "joined");
    CHECK_THAT(advice_of(folder, "application"), Contains("joined is not a folder"));
}

TEST_CASE("doctor warns of keys of rtc.conf that rtm_host does not know") {
    const JoinedFolder folder;
    folder.edit("joined/rtm/rtc.conf", "naming.enable", "namig.enable");
    const auto checks = checks_of(folder, "rtc.conf");
    REQUIRE(checks.size() == 1);
    CHECK(checks[0]["status"] == "warning");
    CHECK_THAT(checks[0].value("advice", ""), Contains("rtc.conf:2: unknown key namig.enable; did you mean "
                                                       "naming.enable?"));
}

TEST_CASE("doctor reports before the start that another process uses the application's link") {
    const JoinedFolder folder;
    const std::string link = "doctor-" + std::to_string(getpid());
    for (const char* file : {"joined/opros/joined.xml", "joined/rtm/rtc.conf"})
        folder.edit(file, "TalkerComp-EchoRtc", link);
    const auto other = tandem::shm::Segment::join(link, tandem::shm::Side::second, {});
    CHECK_THAT(advice_of(folder, "link " + link), Contains("end process " + std::to_string(getpid())));
}
