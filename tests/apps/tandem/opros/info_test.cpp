// SPDX-License-Identifier: Apache-2.0
#include "tests/apps/tandem/program.hpp"
#include "tests/apps/tandem/shell.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

using tandem::test::tandem_program;

namespace {
nlohmann::json port(const nlohmann::json& info, const std::string& name) {
    for (const auto& each : info["ports"])
        if (each["name"] == name) return each;
    return nullptr;
}
} // namespace

TEST_CASE("tandem opros info shows ports, services, executor and properties of a component") {
    const auto result = tandem_program({"opros", "info", PLUGINS "/opros/HWComp.xml", "--json"});
    REQUIRE(result.exit_code == 0);
    const auto info = result.json();
    CHECK(info["name"] == "HWComp");
    CHECK(info["executor"]["type"] == "periodic");
    CHECK(info["executor"]["period_ms"] == 10);
    CHECK(info["properties"]["scenario"] == "step20");
    CHECK(port(info, "wheelSpeed")["direction"] == "output");
    CHECK(port(info, "refVoltage")["direction"] == "input");
    CHECK(port(info, "refVoltage")["type"] == "std::vector<double>");
    CHECK(port(info, "chair")["methods"][0]["signature"] == "bool ()");
    const auto text = tandem_program({"opros", "info", PLUGINS "/opros/HWComp.xml"});
    CHECK(text.output_contains("executor   periodic, every 10 ms, phase 5 ms, priority 7"));
    CHECK(text.output_contains("emergency_stop: bool ()"));
}

TEST_CASE("tandem opros info accepts a library with or without a profile and shows all kinds of ports") {
    const auto beside = tandem_program({"opros", "info", PLUGINS "/opros/HWComp.so", "--json"}).json();
    CHECK(beside["executor"]["period_ms"] == 10);
    const auto info = tandem_program({"opros", "info", ALL_PORTS, "--json"}).json();
    CHECK(info["executor"].is_null());
    CHECK(port(info, "heard")["kind"] == "event");
    CHECK(port(info, "heard")["type"] == "std::string");
    CHECK(port(info, "said")["direction"] == "output");
    CHECK(port(info, "required")["direction"] == "required");
    CHECK(port(info, "provided")["methods"][0]["signature"] == "double (double)");
}

TEST_CASE("tandem opros info reports in one line why it cannot show a component") {
    const auto refused = [](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"opros", "info"});
        const auto result = tandem_program(arguments);
        INFO(result.errors);
        CHECK(result.exit_code == 1);
        CHECK(result.output.empty());
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
        return result.errors;
    };
    CHECK_THAT(refused({"/nowhere/X.so"}), Catch::Contains("/nowhere/X.so"));
    CHECK_THAT(refused({"/nowhere/X.xml"}), Catch::Contains("/nowhere/X.xml"));
    CHECK_THAT(refused({PLUGINS "/rtm/HWComp.so"}), Catch::Contains("an RTC module"));
    CHECK_THAT(refused({ZOO "/opros/another_tandem.so"}), Catch::Contains("the headers of another Tandem"));
    CHECK_THAT(refused({ZOO "/opros/entry_crashes.so"}), Catch::Contains(" in getComponent()"));
    CHECK_THAT(refused({ZOO "/opros/entry_hangs.so", "--timeout", "1"}), Catch::Contains("within 1 s"));
    CHECK_THAT(refused({ZOO "/opros/static_constructor_aborts.so"}), Catch::Contains("static constructors"));
}

TEST_CASE("tandem opros info runs onInitialize only with --initialize") {
    const Folder folder;
    folder.component("M", FIXTURES "/libmaker.so", "<type>passive</type>",
                     "<property name=\"trouble\">initialize throws</property>");
    const std::string profile = folder.path() / "M.xml";
    CHECK(tandem_program({"opros", "info", profile}).exit_code == 0);
    const auto initialized = tandem_program({"opros", "info", profile, "--initialize"});
    CHECK(initialized.exit_code == 1);
    CHECK_THAT(initialized.errors, Catch::Contains("no device"));
}

TEST_CASE("a property with control characters stays on one line") {
    const Folder folder;
    folder.component("M", FIXTURES "/libmaker.so", "<type>passive</type>",
                     "<property name=\"a&#10;b\">x&#27;[31my</property>");
    const auto info = tandem_program({"opros", "info", folder.path() / "M.xml"});
    CHECK_THAT(info.output, Catch::Contains("a?b       x?[31my\n"));
}

TEST_CASE("an output that cannot be written is an error") {
    const Folder folder;
    folder.component("M", FIXTURES "/libmaker.so");
    const auto full = tandem::test::shell(std::string(TANDEM_PROGRAM " opros info ") +
                                          (folder.path() / "M.xml").string() + " 2>&1 >/dev/full");
    CHECK(full.exit_code == 1);
    CHECK_THAT(full.output, Catch::Contains("standard output cannot be written: No space left on device"));
}

TEST_CASE("tandem opros info finds device libraries where the host finds them") {
    const Folder folder;
    const auto library = folder.write("devices/libLaserApi.so", "");
    folder.component("M", FIXTURES "/libmaker.so", "<type>passive</type>",
                     "<property name=\"ApiName\">LaserApi.dll</property>");
    const auto info = tandem_program({"opros", "info", folder.path() / "M.xml", "--json", "--plugin-path",
                                      folder.path() / "devices"})
                          .json();
    CHECK(info["properties"]["ApiName"] == library.string());
    CHECK(info["properties"]["APIName"] == library.string());
    CHECK(info["properties"].size() == 3); // in its three spellings; where the profile lies is not told
}

TEST_CASE("tandem opros info shows the parts of composites and applications and the members of types") {
    const Folder folder;
    folder.component("M", "maker");
    const auto composite = [&](const std::string& name, const std::string& of, const std::string& port,
                               const std::string& as) {
        return folder.write(name + ".xml",
                            "<composite_component_profile><name>" + name + "</name><subcomponents>" +
                                Folder::sub("In", of) +
                                "</subcomponents>\n<export_ports><export_port><component_name>In"
                                "</component_name><port_name>" +
                                port +
                                "</port_name><port_type>data</port_type>"
                                "<export_port_name>" +
                                as +
                                "</export_port_name></export_port></export_ports>"
                                "</composite_component_profile>");
    };
    const auto info = [](const std::filesystem::path& file, bool json = false) {
        std::vector<std::string> arguments{"opros", "info", file, "--plugin-path", FIXTURES};
        if (json) arguments.emplace_back("--json");
        return tandem_program(arguments);
    };
    composite("Inner", "M.xml", "numbers", "inner");
    const auto outer = info(composite("Outer", "Inner.xml", "inner", "outer"), true).json();
    CHECK(outer["kind"] == "composite");
    CHECK(outer["components"][0]["profile"] == "Inner.xml");
    CHECK(port(outer, "outer")["type"] == "std::vector<double>");
    CHECK(port(outer, "outer")["direction"] == "output");
    CHECK(port(outer, "outer")["of"] == "In.In.numbers");
    const auto wrong = info(composite("Wrong", "Inner.xml", "nope", "outer"));
    CHECK(wrong.exit_code == 1);
    CHECK_THAT(wrong.errors, Catch::Contains("Wrong.xml:2: composite 'In' exports no data port 'nope'"));

    const auto application = info(
        folder.application(Folder::sub("M", "M.xml"), Folder::connect("data", "M", "numbers", "M", "x")));
    CHECK(application.output_contains("application  app\n"));
    CHECK(application.output_contains("M.numbers  M.x"));
    const auto service = info(folder.write(
        "s.xml",
        "<service_port_type_profile><service_port_type><type_name>Arm</type_name><method name=\"Move\" "
        "return_type=\"bool\"><param index=\"1\"><type>double</type><name>t</name></param></method>"
        "</service_port_type></service_port_type_profile>"));
    CHECK(service.output_contains("bool (double t)"));
    const auto data = info(folder.write(
        "d.xml", "<data_type><struct name=\"Point\"><item type=\"double\">x</item></struct></data_type>"));
    CHECK(data.output_contains("Point\nfield  type    default\nx      double"));
}
