// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>
#include <fstream>

#include "apps/wheelchair/run/run_directory.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"
#include "scratch_dir.hpp"

using namespace tandem::wheelchair;

TEST_CASE("the mixed run has both hosts and a link with a unique name, and the providers start first") {
    const RunDirectory run(Options{}, Configuration::mixed, "/programs");
    REQUIRE(run.hosts().size() == 2);
    CHECK(run.hosts()[0].command[0] == "/programs/opros_host");
    const std::string link = run.links().at("Adaptor");
    CHECK_THAT(link, Catch::StartsWith("wheelchair-"));
    const auto xml = content(run.path() / "opros/wheelchair.xml");
    const auto control = xml.find("<name>ControlComp"), adaptor = xml.find("<name>Adaptor"),
               hw = xml.find("<name>HWComp");
    CHECK(control < adaptor); // the last listed starts first
    CHECK(adaptor < hw);
    CHECK_THAT(xml, Catch::Contains("<property name=\"link\">" + link + "<"));
    CHECK_THAT(xml, Catch::Contains("component_name=\"Adaptor\" port_name=\"linkState\""));
    const auto conf = content(run.path() / "rtm/rtc.conf");
    CHECK_THAT(conf, Catch::Contains("InterceptorComp?link=" + link + "&rtc=JoystickComp0"));
    CHECK_THAT(
        conf,
        !Catch::Contains("preactivation")); // InterceptorComp activates the RTC when AdaptorComp starts
    CHECK_THAT(content(run.path() / "rtm/JoystickComp0.conf"),
               Catch::Contains("conf.default.clock: monotonic"));
}

TEST_CASE("the swapped run has a link for each RTC that the joystick talks to") {
    const RunDirectory run(Options{}, Configuration::swapped, "/programs");
    REQUIRE(run.links().size() == 2);
    const auto conf = content(run.path() / "rtm/rtc.conf");
    CHECK_THAT(conf, Catch::Contains("InterceptorComp?link=" + run.links().at("HWAdaptor") + "&rtc=HWComp0"));
    CHECK_THAT(conf, Catch::Contains("InterceptorComp?link=" + run.links().at("ControlAdaptor") +
                                     "&rtc=ControlComp0"));
    CHECK_THAT(conf, Catch::Contains("InterceptorComp0.linkState?port=HWComp0.linkState"));
}

TEST_CASE("the all-RTM run connects every port and activates the hardware first") {
    const RunDirectory run(Options{}, Configuration::rtm, "/programs");
    REQUIRE(run.hosts().size() == 1);
    const auto conf = content(run.path() / "rtm/rtc.conf");
    CHECK_THAT(conf, Catch::Contains("preactivation: HWComp0, JoystickComp0, ControlComp0\n"));
    CHECK_THAT(conf, Catch::Contains("JoystickComp0.reference?port=ControlComp0.reference"));
    CHECK_THAT(conf, Catch::Contains("ControlComp0.joystick?port=JoystickComp0.joystick"));
    CHECK(run.links().empty());
}

TEST_CASE("in lock-step the components stamp in simulated time and the hosts listen for a driver") {
    Options options;
    options.lockstep = true;
    options.scenario = "doorway";
    const RunDirectory run(options, Configuration::opros, "/programs");
    const auto xml = content(run.path() / "opros/wheelchair.xml");
    CHECK_THAT(xml, Catch::Contains("<property name=\"clock\">simulated<"));
    CHECK_THAT(xml, Catch::Contains("<property name=\"poll_us\">0<"));
    CHECK_THAT(xml, Catch::Contains("<property name=\"scenario\">doorway<"));
    const auto& command = run.hosts()[0].command;
    const auto at = std::find(command.begin(), command.end(), "--lockstep");
    REQUIRE(at != command.end());
    CHECK(at[1] == run.step_socket("opros_host"));
    CHECK(run.step_socket("opros_host").size() < 100);
}

TEST_CASE("a run leaves no files unless it is kept, and a kept folder is emptied first") {
    const ScratchDir dir;
    std::filesystem::path gone;
    {
        const RunDirectory run(Options{}, Configuration::opros, "/programs");
        gone = run.path();
        CHECK(std::filesystem::exists(gone));
    }
    CHECK_FALSE(std::filesystem::exists(gone));
    Options options;
    options.keep = dir / "kept";
    { const RunDirectory run(options, Configuration::opros, "/programs"); }
    std::ofstream(dir / "kept/trace/HWComp.trace") << "old";
    { const RunDirectory run(options, Configuration::opros, "/programs"); }
    CHECK(std::filesystem::exists(dir / "kept/opros/wheelchair.xml"));
    CHECK_FALSE(std::filesystem::exists(dir / "kept/trace/HWComp.trace"));
}

TEST_CASE("a folder with other contents is refused and left unchanged") {
    const ScratchDir dir;
    std::filesystem::create_directories(dir / "opros/other");
    Options options;
    options.keep = dir.path();
    CHECK_THROWS_WITH(RunDirectory(options, Configuration::opros, "/programs"),
                      Catch::Contains("contains files that are not from an earlier run"));
    CHECK(std::filesystem::exists(dir / "opros/other"));
}
