// SPDX-License-Identifier: Apache-2.0
#include "host/rt/lock_step/step_client.hpp"
#include "tests/host/opros/engine/running.hpp"
#include "tests/host/process/published_notices.hpp"
#include "tests/support/captured_log.hpp"

#include <dlfcn.h>

using tandem::engine::Application;
using tandem::engine::ComponentHost;

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
using LeakCheckDisabler = __lsan::ScopedDisabler;
#else
struct LeakCheckDisabler {
    ~LeakCheckDisabler() {}
};
#endif

namespace {
const std::string both = Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml");

std::filesystem::path maker_and_printer(const Folder& folder, const std::string& maker_properties = "",
                                        const std::string& connections = "", const std::string& rest = "") {
    folder.component("M", "maker.dll", "<type>periodic</type><period>10</period>", maker_properties);
    folder.component("P", "printer");
    return folder.application(both, connections, rest);
}
std::string trouble(const std::string& kind) { return "<property name=\"trouble\">" + kind + "</property>"; }
std::string library_error(const std::string& library) {
    const Folder folder;
    folder.component("C", library);
    return setup_error(folder.application(Folder::sub("C", "C.xml")), test_options(folder));
}
} // namespace

TEST_CASE("components get their names and properties before they initialize, and the application's "
          "properties override the profile's") {
    const Folder folder;
    folder.component("M", "maker.dll", "<type>passive</type>",
                     "<property name=\"a\">1</property><property name=\"b\">2</property>");
    const auto file = folder.application(
        Folder::sub("Name", "M.xml", "<properties><property name=\"b\">3</property></properties>"));
    Application application(file, test_options(folder));
    CHECK(recorder(application, "Name").calls == std::vector<std::string>{"initialize Name 13"});
    auto& component = application.find_component("Name")->component();
    CHECK(component.getProperty("_opros_xx_internal_xx_Component_Path") ==
          (folder.path() / "res" / "").string());
    CHECK(state(application, "Name") == OPROS_CS_READY);
}

TEST_CASE("a property that names a device library becomes its path and other properties are unchanged") {
    const Folder folder;
    folder.write("libLaserApi.so", "");
    folder.component(
        "M", "maker.dll", "<type>passive</type>",
        "<property name=\"ApiName\">LaserApi</property><property name=\"DllName\">nowhere</property>"
        "<property name=\"Name\">LaserApi</property>");
    Application application(folder.application(Folder::sub("M", "M.xml")), test_options(folder));
    auto& component = application.find_component("M")->component();
    CHECK(component.getProperty("ApiName") == (folder.path() / "libLaserApi.so").string());
    CHECK(component.getProperty("DllName") == "nowhere");
    CHECK(component.getProperty("APIName") == component.getProperty("ApiName"));
    CHECK(component.getProperty("Name") == "LaserApi");
    CHECK(component.getProperty("opros.component.dir") == (folder.path() / "").string());
}

TEST_CASE("a component does not see the dlerror() of other code") {
    const Folder folder;
    folder.component("M", "maker.dll");
    Application application(folder.application(Folder::sub("M", "M.xml")), test_options(folder));
    CHECK(dlopen("no such library", RTLD_NOW) == nullptr);
    application.start();
    CHECK(dlerror() == nullptr);
}

TEST_CASE("an application starts, is stepped and stops in order") {
    const Folder folder;
    Application application(maker_and_printer(folder), test_options(folder));
    application.start();
    CHECK(state(application, "M") == OPROS_CS_ACTIVE);
    application.step("M");
    application.step("M");
    CHECK(recorder(application, "M").executions == 2);
    CHECK(recorder(application, "M").updates == 2);
    application.stop();
    CHECK(state(application, "M") == OPROS_CS_INACTIVE);
    application.step("M");
    CHECK(recorder(application, "M").executions == 2);
    CHECK_THROWS_WITH(application.step("X"), Catch::Contains("no component 'X'") && Catch::Contains("M, P"));
}

TEST_CASE("data, events and service calls cross between components") {
    const Folder folder;
    const auto file = maker_and_printer(folder, "<property name=\"calls\">yes</property>",
                                        Folder::connect("data", "M", "numbers", "P", "numbers") +
                                            Folder::connect("event", "M", "news", "P", "news") +
                                            Folder::connect("service", "M", "math", "P", "math"));
    Application application(file, test_options(folder));
    application.start();
    application.step("M");
    application.step("P");
    Recorder& printer = recorder(application, "P");
    CHECK(printer.last_number == 1);
    CHECK(printer.last_event == "tick: cycle 1");
    CHECK(printer.calls == std::vector<std::string>{"noted"});
    CHECK(recorder(application, "M").last_number == 1.5);
    CHECK(recorder(application, "M").calls.back() == "turned turned hand");
}

TEST_CASE("a component that throws goes to ERROR and the others continue") {
    const std::string kind = GENERATE("execute throws", "execute throws a number");
    const Folder folder;
    Application application(maker_and_printer(folder, trouble(kind)), test_options(folder));
    application.start();
    application.step("M");
    CHECK_THROWS_WITH(application.step("M"), Catch::Contains("component M: onExecute threw an exception"));
    CHECK(state(application, "M") == OPROS_CS_ERROR);
    const auto reasons = [] { return published_notices(tandem::process::NoticeKind::component); };
    REQUIRE(reasons().size() == 1);
    CHECK_THAT(reasons()[0], Catch::StartsWith("component M: onExecute threw an exception: "));
    CHECK(recorder(application, "M").calls.back() == "error");
    application.step("P");
    CHECK(recorder(application, "P").executions == 1);
    application.step("M");
    CHECK(recorder(application, "M").executions == 2);
    CHECK(application.find_component("M")->component().recover() == OPROS_SUCCESS);
    CHECK(reasons().empty());
}

TEST_CASE("an exception puts only an ACTIVE component in ERROR, and the log says so only then") {
    const Folder folder;
    Application application(maker_and_printer(folder), test_options(folder));
    application.start();
    ComponentHost& printer = *application.find_component("P");
    const std::string text = "component P: onEvent threw an exception: lost";
    const auto throw_in_event = [&] {
        return printer.run_guarded("onEvent", [] { throw std::runtime_error("lost"); });
    };
    REQUIRE(printer.request(TRANSITION_STOP).empty());
    const tandem::test::CapturedLog log;
    CHECK(throw_in_event() == text);
    CHECK(state(application, "P") == OPROS_CS_INACTIVE);
    CHECK(log.lines_with(text) == 1);
    CHECK(log.lines_with("ERROR") == 0);
    CHECK(printer.last_error().empty());
    REQUIRE(printer.request(TRANSITION_START).empty());
    CHECK(throw_in_event() == text);
    CHECK(state(application, "P") == OPROS_CS_ERROR);
    CHECK(log.lines_with(text + "; it goes to ERROR") == 1);
    CHECK(printer.last_error() == text);
}

TEST_CASE("a component in ERROR that is recovered or reset is executed again, with its connections") {
    const bool by_reset = GENERATE(true, false);
    const Folder folder;
    folder.component("M", "maker", "<type>periodic</type><period>1</period>", trouble("stops itself"));
    folder.component("P", "printer", "<type>periodic</type><period>1</period>");
    Application application(folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml"),
                                               Folder::connect("data", "M", "numbers", "P", "numbers")),
                            test_options(folder, false));
    application.start();
    auto& broken = application.find_component("M")->component(); // it goes to ERROR in each cycle
    std::vector<std::string> expected{"initialize M ", "start", "error"};
    for (int times = 1;; ++times) {
        REQUIRE(eventually([&] { return broken.getStatus() == OPROS_CS_ERROR; }));
        REQUIRE(eventually([&] { return recorder(application, "P").last_number == times; }));
        if (times == 3) break;
        if (by_reset) {
            CHECK(broken.reset() == OPROS_SUCCESS);
            expected.insert(expected.end(), {"reset", "initialize M ", "start", "error"});
        } else {
            CHECK(broken.recover() == OPROS_SUCCESS);
            CHECK(broken.start() == OPROS_SUCCESS);
            expected.insert(expected.end(), {"recover", "start", "error"});
        }
    }
    application.shut_down();
    expected.push_back("destroy");
    CHECK(recorder(application, "M").calls == expected);
}

TEST_CASE(
    "a component that cannot initialize is left out, with its connections, and one that cannot start waits") {
    const std::string kind = GENERATE("initialize fails", "initialize throws", "start fails");
    const Folder folder;
    Application application(
        maker_and_printer(folder, trouble(kind), Folder::connect("data", "M", "numbers", "P", "numbers")),
        test_options(folder));
    application.start();
    CHECK(application.find_component("M")->has_not_started());
    CHECK(application.find_component("M")->has_failed() == (kind != "start fails"));
    CHECK(application.components_not_running() == std::vector<std::string>{"M"});
    CHECK(state(application, "M") == OPROS_CS_ERROR);
    CHECK(state(application, "P") == OPROS_CS_ACTIVE);
    // onError is for what has been initialised: it may have to switch something off.
    CHECK((recorder(application, "M").calls.back() == "error") == (kind == "start fails"));
}

TEST_CASE("a component that cannot be loaded is left out and the others run") {
    const Folder folder;
    folder.component("B", GENERATE("missing.dll", "no_factory", "throwing_factory", "null_factory"));
    folder.component("P", "printer");
    const auto file = folder.application(Folder::sub("B", "B.xml") + Folder::sub("P", "P.xml"),
                                         Folder::connect("data", "B", "numbers", "P", "numbers"),
                                         "<coordination><depends source=\"P\" target=\"B\"/></coordination>");
    Application application(file, test_options(folder));
    application.start();
    CHECK(application.find_component("B") == nullptr);
    CHECK(state(application, "P") == OPROS_CS_ACTIVE);
}

TEST_CASE("a connection that cannot be made is left out and the others are made") {
    const Folder folder;
    const auto wrong = GENERATE(as<std::string>(), Folder::connect("data", "M", "numbers", "X", "numbers"),
                                Folder::connect("data", "X", "numbers", "P", "numbers"),
                                Folder::connect("data", "M", "nothing", "P", "numbers"),
                                Folder::connect("data", "M", "words", "P", "numbers"),
                                Folder::connect("event", "M", "numbers", "P", "news"));
    const auto file =
        maker_and_printer(folder, "", wrong + Folder::connect("data", "M", "numbers", "P", "numbers"));
    Application application(file, test_options(folder));
    application.start();
    application.step("M");
    application.step("P");
    CHECK(recorder(application, "P").last_number == 1);
    CHECK_THAT(setup_error(file, test_options(folder)), Catch::Contains("app.xml:7: "));
}

TEST_CASE("a connection of an unknown component is an error that lists the known ones") {
    const Folder folder;
    CHECK_THAT(setup_error(maker_and_printer(folder, "", Folder::connect("data", "M", "o", "X", "i")),
                           test_options(folder)),
               Catch::Contains("app.xml:7: unknown component 'X', expected one of M, P"));
}

TEST_CASE("with strict a component that fails ends the application") {
    const std::string kind = GENERATE("initialize fails", "initialize throws", "start fails");
    const Folder folder;
    auto options = test_options(folder);
    options.strict = true;
    const auto file = maker_and_printer(folder, trouble(kind));
    const auto run = [&] { Application(file, options).start(); };
    CHECK_THROWS_WITH(run(), Catch::Contains("component 'M' did not " + kind.substr(0, kind.find(' '))));
    folder.component("M", "missing.dll");
    CHECK_THROWS_WITH(run(), Catch::Contains("M.xml:3: library 'missing.dll' not found"));
}

TEST_CASE("an application ends if none of its components can start") {
    const Folder folder;
    folder.component("M", "maker", "<type>passive</type>", trouble("start fails"));
    Application application(folder.application(Folder::sub("M", "M.xml")), test_options(folder));
    CHECK_THROWS_WITH(application.start(), Catch::Contains("no component has started"));
}

TEST_CASE("a component that does not return is named and the others are stopped") {
    const std::string kind = GENERATE("execute hangs", "stop hangs");
    const LeakCheckDisabler stuck_component_leaks;
    const Folder folder;
    auto options = test_options(folder, false);
    options.grace = std::chrono::milliseconds(50);
    Application application(maker_and_printer(folder, trouble(kind)), options);
    application.start();
    Recorder& m = recorder(application, "M");
    CHECK(eventually([&] { return m.executions > 0; }));
    application.shut_down();
    CHECK(application.stuck_components() == std::vector<std::string>{"M"});
    CHECK(state(application, "P") == OPROS_CS_DESTROYED);
}

TEST_CASE("a component that returns from onExecute only when it is stopped is not stuck") {
    const Folder folder;
    auto options = test_options(folder, false);
    options.grace = std::chrono::milliseconds(50);
    Application application(maker_and_printer(folder, trouble("execute waits for stop")), options);
    application.start();
    CHECK(eventually([&] { return recorder(application, "M").executions > 0; }));
    application.stop();
    CHECK(application.stuck_components().empty());
    CHECK(state(application, "M") == OPROS_CS_INACTIVE);
}

TEST_CASE("a failing service call and a returned error leave the component ACTIVE") {
    const std::string kind = GENERATE("call", "returns an error");
    const Folder folder;
    Application application(maker_and_printer(folder, trouble(kind)), test_options(folder));
    application.start();
    application.step("M");
    application.step("M");
    CHECK(state(application, "M") == OPROS_CS_ACTIVE);
    CHECK(recorder(application, "M").executions == 2);
}

TEST_CASE("a library that cannot be used is an error at the line of its name") {
    CHECK_THAT(library_error("missing.dll"), Catch::Contains("C.xml:3: library 'missing.dll' not found") &&
                                                 Catch::Contains("libmissing.dll.so"));
    CHECK_THAT(library_error("no_factory"),
               Catch::Contains("C.xml:3:") &&
                   Catch::Contains("expected an OPRoS component, which exports getComponent"));
    CHECK_THAT(library_error("throwing_factory"), Catch::Contains("threw an exception: out of arms"));
    CHECK_THAT(library_error("null_factory"), Catch::Contains("returned NULL"));
}

TEST_CASE("the same library may serve several components") {
    const Folder folder;
    folder.component("M", "maker");
    Application application(folder.application(Folder::sub("A", "M.xml") + Folder::sub("B", "M.xml")),
                            test_options(folder));
    CHECK(recorder(application, "A").calls[0] == "initialize A ");
    CHECK(recorder(application, "B").calls[0] == "initialize B ");
}

TEST_CASE("a component is stepped through the lock-step socket") {
    const Folder folder;
    Application application(maker_and_printer(folder), test_options(folder));
    application.start();
    tandem::rt::StepClient client(folder.path() / "step", std::chrono::seconds(10));
    client.step("M");
    CHECK(recorder(application, "M").executions == 1);
    CHECK_THROWS_WITH(client.step("X"), Catch::Contains("no component 'X'"));
}
