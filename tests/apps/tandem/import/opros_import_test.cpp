// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/application_profile.hpp"
#include "tests/apps/tandem/program.hpp"
#include "tests/apps/tandem/shell.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <algorithm>

using Catch::Contains;
using tandem::test::tandem_program;

namespace {

namespace fs = std::filesystem;

std::string component_profile(const std::string& name, const std::string& library,
                              const std::string& semantics = "<type>passive</type>",
                              const std::string& ports = "") {
    return "<component_profile>\n<name>" + name + "</name>\n<execution_environment>\n<library_name>" +
           library + "</library_name>\n</execution_environment>\n<execution_semantics>\n" + semantics +
           "\n</execution_semantics>\n<ports>\n" + ports + "</ports>\n</component_profile>\n";
}

std::string application_profile(const std::string& components) {
    return "<package_profile>\n<name>app</name>\n<subcomponents>\n" + components +
           "</subcomponents>\n<port_connections>\n" +
           Folder::connect("data", "Left", "numbers", "Right", "numbers") +
           "</port_connections>\n</package_profile>\n";
}

const std::string two_components =
    Folder::sub("Left", "Left.xml") + "\n" + Folder::sub("Right", "Right.xml") + "\n";

/// An engine's folder with system.xml and the application Packages/app of two components with their
/// libraries.
struct Engine : Folder {
    Engine() {
        write("engine/Packages/app/app.xml", application_profile(two_components));
        add_component("engine/Packages/app/Left/Left.xml", "maker", component_profile("Left", "maker.dll"));
        add_component("engine/Packages/app/Right/Right.xml", "printer",
                      component_profile("Right", "printer"));
        write("engine/Packages/app/Left/res/words.txt", "words");
    }
    void add_component(const std::string& file, const std::string& library,
                       const std::string& profile) const {
        const auto written = write(file, profile);
        const std::string name = "lib" + library + ".so";
        fs::copy_file(fs::path(FIXTURES) / name, written.parent_path() / name);
    }
    fs::path output() const { return path() / "moved"; }
    tandem::test::Result import(std::vector<std::string> more = {}) const {
        std::vector<std::string> all{"opros", "import", path() / "engine", "-o", output()};
        all.insert(all.end(), more.begin(), more.end());
        return tandem_program(all);
    }
    std::string refused(const std::vector<std::string>& more = {}) const {
        const auto result = import(more);
        INFO(result.output << result.errors);
        CHECK(result.exit_code == 1);
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
        CHECK(!fs::exists(output()));
        return result.errors;
    }
};

} // namespace

TEST_CASE("tandem opros import converts an engine's application into a folder that tandem run runs") {
    const Engine engine;
    engine.write("engine/Packages/app/Left/libmaker.dll.so", "built for the engine");
    const auto result = engine.import();
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(result.output, !Contains("to do: ") && Contains("next: tandem run"));
    const std::string page = BUILD_TREE "/share/doc/tandem/host/opros/README.md";
    CHECK_THAT(result.output, Contains("\nalways: " + page + " lists"));
    CHECK(std::filesystem::exists(page));
    for (const char* file :
         {"app.xml", "Left/Left.xml", "Left/libmaker.so", "Left/res/words.txt", "Right/libprinter.so"})
        CHECK(fs::exists(engine.output() / "opros" / file));
    CHECK(!fs::exists(engine.output() / "opros/Left/libmaker.dll.so"));
    const auto run = tandem::test::run_host(TANDEM_PROGRAM " run --strict", engine.output());
    INFO(run.output);
    CHECK(run.exit_code == 0);
}

TEST_CASE("tandem opros import accepts applications with all components in one folder, and selects one of "
          "several") {
    const Engine engine;
    engine.write("engine/Packages/flat.xml", application_profile(two_components));
    engine.add_component("engine/Packages/flat/Left.xml", "maker", component_profile("Left", "maker"));
    engine.add_component("engine/Packages/flat/Right.xml", "printer", component_profile("Right", "printer"));
    CHECK_THAT(engine.refused(),
               Contains("several applications: app/app.xml, flat.xml; choose one with --app"));
    CHECK_THAT(engine.refused({"--app", "other"}),
               Contains("no application 'other', but: app/app.xml, flat.xml"));
    const auto result = engine.import({"--app", "flat", "--link", "robot"});
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK(fs::exists(engine.output() / "opros/flat/libmaker.so"));
    const auto info = tandem_program({"opros", "info", engine.output() / "opros/flat.xml"});
    INFO(info.output << info.errors);
    CHECK(info.output_contains("Adaptor"));
}

TEST_CASE("tandem opros import names needed files that it cannot read") {
    const Engine engine;
    engine.write("engine/Packages/app/app.xml", "<pakage_profile><name>app</name>");
    CHECK_THAT(engine.refused(), Contains("app.xml:1: not well-formed XML"));
    fs::remove(engine.path() / "engine/Packages/app/app.xml");
    fs::create_symlink("nowhere.xml", engine.path() / "engine/Packages/app/app.xml");
    CHECK_THAT(engine.refused(), Contains("app.xml cannot be read: no such file"));

    engine.write("engine/Packages/flat.xml", application_profile(two_components));
    engine.add_component("engine/Packages/flat/Left.xml", "maker", component_profile("Left", "maker"));
    engine.add_component("engine/Packages/flat/Right.xml", "printer", component_profile("Right", "printer"));
    fs::copy_file(engine.path() / "engine/Packages/flat.xml",
                  engine.path() / "engine/Packages/flat/flat.xml");
    engine.write("engine/Packages/flat/Types.xml", "<data_type>");
    CHECK_THAT(engine.refused({"--app", engine.path() / "engine/Packages/flat/flat.xml"}),
               Contains("Types.xml:1: not well-formed XML"));
}

TEST_CASE("tandem opros import copies components from other places into the folder of the application") {
    const Engine engine;
    engine.add_component("engine/shared/profile/Left.xml", "maker", component_profile("Left", "maker"));
    engine.write(
        "engine/Packages/app/app.xml",
        application_profile(Folder::sub("Other", "../../shared/profile/Left.xml") + "\n" + two_components));
    const auto result = engine.import();
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK(fs::exists(engine.output() / "opros/Other/Left.xml"));
    CHECK(fs::exists(engine.output() / "opros/Other/libmaker.so"));
    CHECK_THAT(result.output, !Contains("to do: "));
    const auto info = tandem_program({"opros", "info", engine.output() / "opros/app.xml"});
    INFO(info.output << info.errors);
    CHECK(info.exit_code == 0);
    CHECK_THAT(info.output, Contains("Other"));
}

TEST_CASE("tandem opros import reports what in the profiles and system.xml has a different effect") {
    const Engine engine;
    engine.write("engine/system.xml",
                 "<system_config>\n<system_props>\n"
                 "<prop name=\"sys.console\">on</prop>\n<prop name=\"log.dir\">Log</prop>\n"
                 "</system_props>\n<io_manager>\n<io id=\"tcp\" enable=\"true\"/>\n</io_manager>\n"
                 "</system_config>\n");
    engine.write("engine/Packages/app/app.xml",
                 application_profile(Folder::sub("Left", "Left.xml", "<node_id>Robot.One</node_id>") + "\n" +
                                     Folder::sub("Right", "Right.xml", "<node_id>Robot.Two</node_id>") +
                                     "\n"));
    engine.write("engine/Packages/app/Left/Left.xml",
                 component_profile("Left", "maker", "<type>periodic</type><period>10</period>"));
    engine.write("engine/Packages/app/Right/Right.xml",
                 component_profile("Right", "printer", "<type>non-periodic</type>",
                                   "<data_port><name>numbers</name><usage>input</usage>"
                                   "<queue_size>7</queue_size></data_port>\n"));
    const auto result = engine.import();
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    for (const char* line :
         {"system.xml:3: sys.console on: there is no console", "system.xml:4: log.dir Log: the log goes to",
          "system.xml:7: io tcp: not opened",
          "app.xml: a component that fails: ", "Left.xml:7: Left: a periodic component: has no real-time",
          "Right.xml:7: Right: execution type non-periodic: runs when an input has arrived",
          "Right: queue of port numbers for 7 values: takes effect"})
        CHECK_THAT(result.output, Contains(line));
    CHECK_THAT(result.output, Contains("app.xml:1: the components run on several nodes, and no system.xml") &&
                                  Contains("tandem run --node Robot.One"));
}

TEST_CASE("tandem opros import takes over the engine's node, and runs only the components of this node") {
    const Engine engine;
    engine.write("engine/system.xml",
                 "<system_config>\n<local_node_id>Robot.One</local_node_id>\n<component_manager><node_map>\n"
                 "<node id=\"Robot.Two\" protocol=\"tcp\"><prop name=\"ip.addr\">10.0.0.2</prop>"
                 "<prop name=\"ip.port\">2020</prop></node>\n</node_map></component_manager>\n"
                 "</system_config>\n");
    engine.write("engine/Packages/app/app.xml",
                 application_profile(Folder::sub("Left", "Left.xml") + "\n" +
                                     Folder::sub("Right", "Right.xml", "<node_id>Robot.Two</node_id>") +
                                     "\n"));
    fs::remove_all(engine.path() / "engine/Packages/app/Right"); // is on the other machine
    const auto result = engine.import();
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(result.output, Contains("system.xml:4: node Robot.Two: reached by CORBA through port 2810"));
    CHECK_THAT(result.output, Contains("Right: node_id Robot.Two: does not run here"));
    CHECK_THAT(result.output,
               Contains("<node_map> has no address of node Robot.One; add <node id=\"Robot.One\">"));
    CHECK_THAT(result.output, !Contains("no address of node Robot.Two"));
    const auto written = tandem::engine::read_application_profile(engine.output() / "opros/app.xml");
    CHECK(written.local_node == "Robot.One");
    CHECK(written.subcomponents.at(0).node == "Robot.One");
    REQUIRE(written.nodes.size() == 1);
    CHECK(written.nodes[0].id == "Robot.Two");
    CHECK(written.nodes[0].host == "10.0.0.2");
    CHECK(written.nodes[0].port == 2810);
}

TEST_CASE("tandem opros import names components to build and their sources") {
    const Engine engine;
    fs::remove(engine.path() / "engine/Packages/app/Left/libmaker.so");
    engine.write("engine/sources/Left_V1.0/src/Left.cpp",
                 "extern \"C\" void* getComponent() { return 0; }\n");
    engine.write("engine/Packages/app/Right/Right.xml",
                 component_profile("Right", "printer", "<type>periodic</type>"));
    const auto result = engine.import();
    INFO(result.output << result.errors);
    REQUIRE(result.exit_code == 0);
    const std::string opros = (engine.output() / "opros").string();
    CHECK_THAT(result.output,
               Contains("Left.xml:4: component Left: its library was not found; tandem opros build ") &&
                   Contains("engine/sources/Left_V1.0 --profile " + opros + "/Left/Left.xml\n"));
    CHECK_THAT(result.output,
               Contains("to do: " + opros + "/Right/Right.xml:6: a periodic component needs a <period>"));
    CHECK_THAT(result.output, Contains("next: do the tasks above, then run tandem run"));
}

TEST_CASE("tandem opros import refuses bad input with one line that names the place, and leaves no files") {
    const Folder empty;
    const auto nothing = tandem_program({"opros", "import", empty.path(), "-o", empty.path() / "moved"});
    CHECK(nothing.exit_code == 1);
    CHECK_THAT(nothing.errors, Contains("has no application profile"));
    const auto refused = [](const std::string& file, const std::string& text) {
        const Engine engine;
        engine.write("engine/" + file, text);
        return engine.refused();
    };
    CHECK_THAT(refused("Packages/app/app.xml", "<package_profile>\n<name>\n"),
               Contains("app.xml:") && Contains("not well-formed"));
    CHECK_THAT(refused("Packages/app/app.xml", application_profile(Folder::sub("Left", "Gone.xml"))),
               Contains("app.xml:4: profile 'Gone.xml' of component 'Left' not found"));
    CHECK_THAT(refused("Packages/app/Left/Left.xml", "<component_profile>\n<name>"),
               Contains("Left.xml:2: not well-formed"));
    CHECK_THAT(refused("system.xml", "<config/>"), Contains("system.xml:1: "));
}
