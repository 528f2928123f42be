// SPDX-License-Identifier: Apache-2.0
#include "host/local/local_endpoint.hpp"
#include "host/local/send_request.hpp"
#include "host/opros/control/application_control.hpp"
#include "host/opros/control/control_server.hpp"
#include "tests/host/opros/engine/running.hpp"
#include "tests/host/process/inventory_lines.hpp"

#include <fmt/format.h>

using Catch::Contains;
using nlohmann::json;
using tandem::control::ApplicationControl;
using tandem::control::ControlServer;
using tandem::engine::Application;

namespace {

/// M, a maker, which sends numbers to P, a printer.
std::filesystem::path maker_and_printer(const Folder& folder, const std::string& trouble) {
    folder.component("M", "maker.dll", "<type>periodic</type><period>5</period>",
                     "<property name=\"trouble\">" + trouble + "</property>");
    folder.component("P", "printer");
    return folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml"),
                              Folder::connect("data", "M", "numbers", "P", "numbers") +
                                  Folder::connect("data", "M", "nothing", "P", "counts"));
}

/// A running application, and its answers.
struct Scene {
    explicit Scene(const std::string& trouble = "none")
        : application(maker_and_printer(folder, trouble), test_options(folder, false)), control([this] {
              application.start();
              return std::make_unique<ApplicationControl>(application, (folder.path() / "app.xml").string());
          }()) {}
    ~Scene() {
        control->close();
        application.shut_down();
        control.reset();
    }
    json ask(const json& request) { return json::parse(control->answer(request.dump())); }
    json ask(const std::string& command, const std::string& component) {
        return ask({{"command", command}, {"component", component}});
    }
    std::string error(const json& request) { return ask(request).value("error", "no error"); }

    const Folder folder;
    Application application;
    std::unique_ptr<ApplicationControl> control;
};

json with_name(const json& list, const std::string& name) {
    for (const auto& each : list)
        if (each["name"] == name) return each;
    return nullptr;
}

} // namespace

TEST_CASE("the components of an application are listed with their states and periods") {
    Scene scene;
    const json list = scene.ask({{"command", "list"}});
    CHECK(list["application"] == "app");
    CHECK(list["pid"] == getpid());
    REQUIRE(list["components"].size() == 2);
    CHECK(list["components"][0]["name"] == "M");
    CHECK(list["components"][0]["state"] == "ACTIVE");
    CHECK(list["components"][0]["period_ms"] == 5);
    CHECK(list["components"][1]["executor"] == "passive");
    CHECK(list["components"][1]["period_ms"].is_null());
}

TEST_CASE("a component shows its ports, its connections, made or not, and its properties") {
    Scene scene;
    const json info = scene.ask("info", "M");
    CHECK(with_name(info["ports"], "numbers")["direction"] == "output");
    CHECK(with_name(info["ports"], "numbers")["type"] == "std::vector<double>");
    CHECK(with_name(info["ports"], "news")["kind"] == "event");
    CHECK(with_name(info["ports"], "math")["direction"] == "required");
    REQUIRE(info["connections"].size() == 2);
    CHECK(info["connections"][0]["to"] == "P.numbers");
    CHECK(info["connections"][0]["problem"] == "");
    CHECK_THAT(info["connections"][1]["problem"].get<std::string>(), Contains("nothing"));
    CHECK(info["properties"]["trouble"] == "none");
    CHECK(info["last_error"] == "");
    CHECK(scene.error({{"command", "info"}, {"component", "N"}}) ==
          fmt::format("opros_host {} has no component N (it has: M, P)", getpid()));
}

TEST_CASE("components, ports and connections that are made are listed for other processes while they exist") {
    using tandem::test::count_parts;
    {
        Scene scene;
        CHECK(count_parts("component\tM\tM\tperiodic\t5000000") == 1);
        CHECK(count_parts("component\tP\tP\tpassive\t0") == 1);
        CHECK(count_parts("port\tM\tnumbers\tdata\toutput\tstd::vector<double>") == 1);
        CHECK(count_parts("port\tM\tmath\tservice\trequired") == 1);
        CHECK(count_parts("connection\tM\tnumbers\tP\tnumbers") == 1);
        CHECK(count_parts("connection") == 1);
        Component& maker = scene.application.find_component("M")->component();
        Port* const numbers = maker.getPort("numbers");
        maker.removePort("numbers");
        CHECK(count_parts("connection") == 0);
        CHECK(count_parts("port\tM\tnumbers") == 0);
        maker.addPort("numbers", numbers);
        CHECK(count_parts("connection\tM\tnumbers\tP\tnumbers") == 1);
        CHECK(count_parts("port\tM\tnumbers") == 1);
    }
    CHECK(tandem::test::read_inventory().lines.empty());
}

TEST_CASE("a component is stopped, started, and recovered from its error, which is shown") {
    Scene scene;
    CHECK(scene.ask("stop", "M")["state"] == "INACTIVE");
    const int executions = recorder(scene.application, "M").executions;
    CHECK(scene.ask("stop", "M")["state"] == "INACTIVE");
    CHECK(scene.ask({{"command", "conf"},
                     {"component", "M"},
                     {"name", "trouble"},
                     {"value", "start fails"}})["properties"]["trouble"] == "start fails");
    CHECK_THAT(scene.error({{"command", "start"}, {"component", "M"}}),
               Contains("component M: onStart failed"));
    CHECK_THAT(scene.ask("info", "M")["last_error"].get<std::string>(), Contains("onStart failed"));
    CHECK_THAT(scene.error({{"command", "start"}, {"component", "M"}}),
               Contains("M is in ERROR; use tandem opros recover M first"));
    CHECK_THAT(scene.error({{"command", "stop"}, {"component", "M"}}),
               Contains("M is in ERROR; use tandem opros recover M first"));
    CHECK(scene.ask("recover", "M")["state"] == "READY");
    CHECK(scene.ask("stop", "M")["state"] == "READY");
    CHECK(scene.ask("info", "M")["last_error"] == "");
    scene.ask({{"command", "conf"}, {"component", "M"}, {"name", "trouble"}, {"value", "none"}});
    CHECK(scene.ask("start", "M")["state"] == "ACTIVE");
    CHECK(eventually([&] { return recorder(scene.application, "M").executions > executions; }));
    CHECK_THAT(scene.error({{"command", "recover"}, {"component", "M"}}),
               Contains("M is ACTIVE, not in ERROR"));
}

TEST_CASE("an unknown property is refused, and the nearest name is shown") {
    Scene scene;
    CHECK_THAT(scene.error({{"command", "conf"}, {"component", "M"}, {"name", "troubel"}, {"value", "x"}}),
               Contains("component M has no property troubel; did you mean trouble?"));
    CHECK(scene.ask("conf", "M")["properties"] == scene.ask("info", "M")["properties"]);
}

TEST_CASE("invalid requests get an error") {
    Scene scene;
    for (const char* request : {"", "[]", "{\"command\": 5}", "{\"command\": \"fly\"}", "\xff\xfe"})
        CHECK_THAT(scene.control->answer(request), Contains("error"));
    CHECK(ApplicationControl::time_limit("{\"timeout_s\": 1e300}") == std::chrono::minutes(10));
    CHECK(ApplicationControl::time_limit("{\"timeout_s\": -1}") == std::chrono::milliseconds(100));
}

TEST_CASE("no properties are reported, and no component is started, when the application ends") {
    Scene scene;
    scene.control->close();
    scene.application.stop();
    CHECK(scene.error({{"command", "info"}, {"component", "M"}}) == "the application ends");
    CHECK(scene.error({{"command", "start"}, {"component", "M"}}) == "the application ends");
}

TEST_CASE("a command for a component that hangs ends after its limit, in a line that names the callback") {
    const Folder folder;
    auto options = test_options(folder, false);
    options.grace = std::chrono::milliseconds(100);
    Application application(maker_and_printer(folder, "execute waits for stop"), options);
    application.start();
    REQUIRE(eventually([&] { return recorder(application, "M").executions > 0; }));
    ControlServer server(application, folder.path() / "app.xml");
    std::filesystem::path socket;
    for (const auto& endpoint : tandem::local::find_local_endpoints(tandem::local::opros_endpoint))
        if (endpoint.pid == getpid()) socket = endpoint.socket;
    const auto reply = tandem::local::send_request(
        socket, R"({"command": "stop", "component": "M", "timeout_s": 0.2})", std::chrono::seconds(30));
    REQUIRE(reply);
    CHECK_THAT(*reply, Contains("component M: stop has not ended within 0.2 s: onExecute has taken"));
    CHECK(
        tandem::local::send_request(socket, R"({"command": "list"})", std::chrono::seconds(30)).has_value());
    server.close();
    application.shut_down();
    CHECK(server.stop_within(std::chrono::seconds(30)));
    CHECK_FALSE(std::filesystem::exists(socket));
}
