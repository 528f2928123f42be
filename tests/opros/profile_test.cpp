// SPDX-License-Identifier: Apache-2.0
#include "host/opros/src/start_order.hpp"
#include "tests/opros/folder.hpp"

#include <catch2/catch.hpp>

using namespace tandem::engine;

namespace {
template <typename Read>
std::string error_of(Read read) {
    try {
        read();
    } catch (const SetupError& error) {
        return error.what();
    }
    return "no error";
}

std::string component_error(const std::string& text) {
    const Folder folder;
    const auto file = folder.write("c.xml", text);
    const std::string message = error_of([&] { read_component_profile(file); });
    CHECK(message.find('\n') == std::string::npos);
    return message;
}

std::string semantics_error(const std::string& semantics) {
    const Folder folder;
    folder.component("c", "c.dll", semantics);
    return error_of([&] { read_component_profile(folder.path() / "c.xml"); });
}
} // namespace

TEST_CASE("a component profile gives library, execution and properties") {
    const Folder folder;
    folder.component("C", " C.dll ",
                     "<type>periodic</type><period>2.5</period><phase>0.5</phase><priority>7</priority>",
                     "<property name=\"a\" type=\"int\">1</property><property name=\"\">x</property>");
    const auto profile = read_component_profile(folder.path() / "C.xml");
    CHECK(profile.name == "C");
    CHECK(profile.library_name == "C.dll");
    CHECK(profile.execution == Execution::periodic);
    CHECK(profile.period == std::chrono::microseconds(2500));
    CHECK(profile.phase == std::chrono::microseconds(500));
    CHECK(profile.priority == 7);
    CHECK(profile.properties == Properties{{"a", "1"}});
}

TEST_CASE("SCHED_OTHER in a profile means no real-time priority") {
    const Folder folder;
    folder.component("C", "C.dll",
                     "<type>passive</type><period/><priority>7</priority><policy>SCHED_OTHER</policy>");
    CHECK(read_component_profile(folder.path() / "C.xml").priority == 0);
}

TEST_CASE("a wrong component profile gets one line with file, line, what is wrong and what was expected") {
    CHECK_THAT(component_error("<component_profile>\n<name>x</nam>\n"),
               Catch::Contains("c.xml:2: not well-formed"));
    CHECK_THAT(component_error("\n<robot/>"),
               Catch::Contains("c.xml:2: root element is <robot>, expected <component_profile>"));
    CHECK_THAT(component_error("<component_profile>\n<name> </name></component_profile>"),
               Catch::Contains("c.xml:2: <component_profile> lacks its <name>"));
    CHECK_THAT(
        component_error("<component_profile>\n<name>x</name>\n<execution_environment/></component_profile>"),
        Catch::Contains("c.xml:3: <execution_environment> lacks its <library_name>"));
    CHECK_THAT(error_of([] { read_component_profile("/nowhere.xml"); }), Catch::Contains("/nowhere.xml"));
}

TEST_CASE("wrong execution semantics are named") {
    CHECK_THAT(semantics_error("<type>sometimes</type>"),
               Catch::Contains("c.xml:4: execution type 'sometimes'"));
    CHECK_THAT(semantics_error("<type>periodic</type>"), Catch::Contains("<period> above 0 ms"));
    CHECK_THAT(semantics_error("<type>periodic</type><period>-1</period>"), Catch::Contains("'-1'"));
    CHECK_THAT(semantics_error("<type>periodic</type><period>10ms</period>"),
               Catch::Contains("expected a number"));
}

TEST_CASE("an application profile of either name gives components, connections and dependencies") {
    const Folder folder;
    const auto file = folder.write(
        "a.xml",
        "<application_profile><name>a</name><subcomponents>" +
            Folder::sub("A", "A.xml",
                        "<node_id>n</node_id><properties><property name=\"k\">v</property></properties>") +
            Folder::sub("B", "B.xml") + "</subcomponents><port_connections>" +
            Folder::connect("event", "A", "out", "B", "in") +
            "</port_connections><coordination><depends source=\"B\" "
            "target=\"A\"/></coordination></application_profile>");
    const auto profile = read_application_profile(file);
    CHECK(profile.subcomponents.size() == 2);
    CHECK(profile.subcomponents[0].properties == Properties{{"k", "v"}});
    CHECK(profile.connections[0].type == OPROS_EVENT);
    CHECK(profile.connections[0].target.text() == "B.in");
    CHECK(profile.dependencies[0].source == "B");
}

TEST_CASE("a wrong application profile gets one line with file and line") {
    const Folder folder;
    const auto read = [&](const std::string& components, const std::string& connections) {
        return error_of([&] { read_application_profile(folder.application(components, connections)); });
    };
    const std::string a = Folder::sub("A", "A.xml");
    CHECK_THAT(read("", ""), Catch::Contains("lists no <subcomponent>"));
    CHECK_THAT(read(a + a, ""), Catch::Contains("app.xml:4: component 'A' is listed twice"));
    CHECK_THAT(read(a, Folder::connect("data", "A", "o", "X", "i")),
               Catch::Contains("app.xml:7: unknown component 'X', the application has A"));
    CHECK_THAT(read(a, Folder::connect("method", "A", "o", "A", "i")),
               Catch::Contains("app.xml:7: port_type is 'method'"));
    CHECK_THAT(read(a, "<port_connection port_type=\"data\"/>"),
               Catch::Contains("app.xml:7: <port_connection> lacks its <source>"));
}

TEST_CASE("components start last listed first, but never before those they depend on") {
    ApplicationProfile profile;
    for (const char* name : {"A", "B", "C"}) profile.subcomponents.push_back({{}, name, "", {}});
    CHECK(start_order(profile) == std::vector<std::string>{"C", "B", "A"});
    profile.dependencies = {{{}, "C", "A"}};
    CHECK(start_order(profile) == std::vector<std::string>{"B", "A", "C"});
    profile.dependencies.push_back({{}, "A", "C"});
    CHECK_THAT(error_of([&] { start_order(profile); }), Catch::Contains("in a circle"));
}

TEST_CASE("a component profile is found in every layout in use") {
    const std::string where = GENERATE("A/", "app/", "");
    const Folder folder;
    folder.write(where + "A.xml", "");
    const auto profile = read_application_profile(folder.application(Folder::sub("A", "A.xml")));
    CHECK(find_component_profile(profile, profile.subcomponents[0], {}) == folder.path() / where / "A.xml");
}

TEST_CASE("a component profile that is nowhere is an error in the line that asks for it") {
    const Folder folder;
    const auto profile = read_application_profile(folder.application(Folder::sub("A", "A.xml")));
    CHECK_THAT(error_of([&] { find_component_profile(profile, profile.subcomponents[0], {"/plugins"}); }),
               Catch::Contains("app.xml:4") && Catch::Contains("/plugins/A.xml"));
}
