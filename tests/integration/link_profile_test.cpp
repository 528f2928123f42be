// SPDX-License-Identifier: Apache-2.0
// `tandem link profile`: what two component folders become.
#include "tests/integration/scratch_folder.hpp"

#include <catch2/catch.hpp>

#include <fstream>

using Catch::Contains;

namespace {

std::string content(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace

TEST_CASE("tandem link profile connects the ports that fit and reports why others do not") {
    ScratchFolder folder;
    folder.add_component("TalkerComp");
    folder.add_component("EchoRtc");
    // In either order.
    const auto result = folder.tandem({"link", "profile", "EchoRtc", "TalkerComp", "--output", "joined"});
    INFO(result.output);
    CHECK(result.exit_code() == 0);
    CHECK_THAT(result.output, Contains("data     TalkerComp.word        EchoRtc0.word        name\n"));
    CHECK_THAT(result.output, Contains("data     EchoRtc0.reply         TalkerComp.reply     name\n"));
    CHECK_THAT(result.output, Contains("service  TalkerComp.dictionary  EchoRtc0.dictionary  name\n"));
    CHECK_THAT(result.output,
               Contains("not connected: TalkerComp.numbers (data output): type mismatch") &&
                   Contains("has signature 'ai', the peer's type IDL:RTC/TimedDoubleSeq:1.0 has '(uu)ad'"));
    CHECK_THAT(result.output,
               Contains("not connected: EchoRtc0.picture (data input): no output data port of TalkerComp is "
                        "left whose type fits\n"));
    CHECK_THAT(result.output, Contains("next: tandem run joined\n"));
    CHECK_THAT(
        content(folder.path() / "joined/rtm/rtc.conf"),
        Contains(
            "manager.components.precreate: EchoRtc, InterceptorComp?link=TalkerComp-EchoRtc&rtc=EchoRtc0\n"));
    CHECK_THAT(content(folder.path() / "joined/opros/joined.xml"),
               Contains("<property name=\"link\">TalkerComp-EchoRtc<"));
    CHECK(std::filesystem::exists(folder.path() / "joined/opros/AdaptorComp.xml"));
}

TEST_CASE("tandem link profile uses data ports of the RTC as event ports if events fit them") {
    ScratchFolder folder;
    folder.add_component("AlarmComp");
    folder.add_component("AlarmRtc");
    const auto result = folder.tandem({"link", "profile", "AlarmComp", "AlarmRtc", "--output", "joined"});
    INFO(result.output);
    CHECK(result.exit_code() == 0);
    CHECK_THAT(result.output, Contains("event  AlarmComp.alarm   AlarmRtc0.raised  type\n"));
    CHECK_THAT(result.output, Contains("event  AlarmRtc0.answer  AlarmComp.notice  type\n"));
    CHECK_THAT(result.output,
               Contains("not connected: AlarmComp.number (event output): type mismatch") &&
                   Contains("an event with content int is 'si' (its id and the content), the peer's type "
                            "IDL:TestAlarm/TimedAlarm:1.0 is '(uu)sd'"));
    CHECK_THAT(content(folder.path() / "joined/opros/joined.xml"),
               Contains("<property name=\"event_ports\">answer, raised<"));
}

TEST_CASE("tandem link profile sets properties of AdaptorComp that make ports fit") {
    ScratchFolder folder;
    folder.add_component("TalkerComp");
    folder.add_component("EchoRtc");
    const auto result = folder.tandem({"link", "profile", "TalkerComp", "EchoRtc", "--property",
                                       "convert.numbers=widen", "--property", "call_timeout=250"});
    INFO(result.output);
    CHECK(result.exit_code() == 0);
    CHECK_THAT(result.output, Contains("data     TalkerComp.numbers"));
    CHECK_THAT(content(folder.path() / "TalkerComp-EchoRtc/opros/TalkerComp-EchoRtc.xml"),
               Contains("<property name=\"call_timeout\">250<") &&
                   Contains("<property name=\"convert.numbers\">widen<"));
    const auto refused =
        folder.tandem({"link", "profile", "TalkerComp", "EchoRtc", "--property", "link=x", "-o", "other"});
    CHECK(refused.exit_code() == 1);
    CHECK_THAT(refused.output,
               Contains("tandem: --property link: this property is set by the command; name the link "
                        "with --link\n"));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "other"));
}

TEST_CASE("tandem link profile copies the execution settings of the RTC's own rtc.conf") {
    ScratchFolder folder;
    folder.add_component("TalkerComp");
    folder.add_component("EchoRtc");
    std::ofstream(folder.path() / "EchoRtc/rtc.conf")
        << "exec_cxt.periodic.rate: 50\ntest.EchoRtc.config_file: echo.conf\n"
           "corba.nameservers: robot:2809\n";
    std::ofstream(folder.path() / "EchoRtc/echo.conf") << "slow_ms: 1\n";
    const auto result = folder.tandem({"link", "profile", "TalkerComp", "EchoRtc"});
    INFO(result.output);
    CHECK(result.exit_code() == 0);
    const std::string conf = content(folder.path() / "TalkerComp-EchoRtc/rtm/rtc.conf");
    CHECK_THAT(conf, Contains("exec_cxt.periodic.rate: 50\n"));
    CHECK_THAT(conf, Contains("test.EchoRtc.config_file: " + (folder.path() / "EchoRtc/echo.conf").string()));
    CHECK_THAT(conf, !Contains("nameservers"));
    CHECK_THAT(result.output, Contains("'corba.nameservers' is not used"));
}

TEST_CASE("tandem link profile writes nothing if no ports fit, and reports the reason for each port") {
    ScratchFolder folder;
    folder.add_component("CameraComp");
    folder.add_component("AlarmRtc");
    const auto result = folder.tandem({"link", "profile", "CameraComp", "AlarmRtc", "--output", "joined"});
    INFO(result.output);
    CHECK(result.exit_code() == 1);
    CHECK_THAT(result.output,
               Contains("tandem: no port of CameraComp fits one of AlarmRtc0, for the reasons above") &&
                   Contains("not connected: AlarmRtc0.raised (data input): ") && !Contains("next:") &&
                   !Contains("written "));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "joined"));
    const auto as_json = folder.tandem({"link", "profile", "CameraComp", "AlarmRtc", "--json"});
    CHECK(as_json.exit_code() == 1);
    CHECK_THAT(as_json.output, Contains("\"connections\": []") && !Contains("\"application\""));
    // It may still be shown as an RTC, whose ports are connected there.
    const auto shared = folder.tandem({"link", "profile", "CameraComp", "AlarmRtc", "--output", "joined",
                                       "--property", "share=CameraComp"});
    INFO(shared.output);
    CHECK(shared.exit_code() == 0);
    CHECK_THAT(shared.output,
               Contains("no port can be connected\n") && Contains("next: tandem run joined\n"));
}

TEST_CASE("tandem link profile refuses anything but one component of each model, and leaves no files") {
    ScratchFolder folder;
    folder.add_component("TalkerComp");
    folder.add_component("CameraComp");
    folder.add_component("EchoRtc");
    std::filesystem::create_directory(folder.path() / "empty");
    const auto refusal = [&](const char* first, const char* second) {
        const auto result = folder.tandem({"link", "profile", first, second, "--output", "joined"});
        CHECK(result.exit_code() == 1);
        CHECK_FALSE(std::filesystem::exists(folder.path() / "joined"));
        return result.output;
    };
    CHECK_THAT(
        refusal("TalkerComp", "CameraComp"),
        Contains(
            "tandem: TalkerComp and CameraComp are both OPRoS components: expected one of each model\n"));
    CHECK_THAT(refusal("EchoRtc", "EchoRtc"), Contains("are both RTCs"));
    CHECK_THAT(
        refusal("EchoRtc", "empty"),
        Contains("empty has no built RTC (build it with tandem rtm build) and is not an OPRoS component"));
    CHECK_THAT(refusal("EchoRtc", "nowhere"), Contains("nowhere does not exist"));
    const auto occupied =
        folder.tandem({"link", "profile", "TalkerComp", "EchoRtc", "--output", "TalkerComp"});
    CHECK(occupied.exit_code() == 1);
    CHECK_THAT(
        occupied.output,
        Contains("TalkerComp exists and is not empty; remove it, or name another folder with --output DIR"));
    CHECK(std::filesystem::exists(folder.path() / "TalkerComp/TalkerComp.so"));
    const auto misnamed = folder.tandem(
        {"link", "profile", "TalkerComp", "EchoRtc", "--output", "joined", "--link", "my link"});
    CHECK(misnamed.exit_code() == 1);
    CHECK_THAT(misnamed.output, Contains("link name 'my link': expected 1 to 64 characters"));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "joined"));
}
