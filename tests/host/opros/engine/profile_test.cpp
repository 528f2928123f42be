// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/start_order.hpp"
#include "tests/host/opros/engine/folder.hpp"

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
    CHECK(profile.execution_type == ExecutionType::periodic);
    CHECK(profile.period == std::chrono::microseconds(2500));
    CHECK(profile.phase == std::chrono::microseconds(500));
    CHECK(profile.priority == 7);
    CHECK(profile.properties == Properties{{"a", "1"}});
}

TEST_CASE("real-time scheduling is only for a profile that names a policy") {
    const Folder folder;
    const auto scheduling = [&](const std::string& policy) {
        folder.component("C", "C.dll", "<type>passive</type><period/><priority>7</priority>" + policy);
        return read_component_profile(folder.path() / "C.xml").scheduling_policy;
    };
    CHECK(scheduling("") == SchedulingPolicy::other);
    CHECK(scheduling("<policy>SCHED_OTHER</policy>") == SchedulingPolicy::other);
    CHECK(scheduling("<policy>SCHED_FIFO</policy>") == SchedulingPolicy::fifo);
    CHECK(scheduling("<policy>SCHED_RR</policy>") == SchedulingPolicy::round_robin);
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

TEST_CASE("wrong execution semantics are an error that quotes them") {
    CHECK_THAT(semantics_error("<type>sometimes</type>"),
               Catch::Contains("c.xml:4: execution type 'sometimes'"));
    CHECK_THAT(semantics_error("<type>periodic</type>"),
               Catch::Contains("<period> above 0 and of at most 1e9 ms"));
    CHECK_THAT(semantics_error("<type>periodic</type><period>-1</period>"), Catch::Contains("'-1'"));
    CHECK_THAT(semantics_error("<type>periodic</type><period>10ms</period>"),
               Catch::Contains("expected a number"));
    CHECK_THAT(semantics_error("<type>periodic</type><period>nan</period>"),
               Catch::Contains("expected a number"));
    CHECK_THAT(semantics_error("<type>periodic</type><period>1</period><phase>1e300</phase>"),
               Catch::Contains("<phase> is '1e300'"));
    CHECK_THAT(semantics_error("<type>passive</type><policy>SCHED_MINE</policy>"),
               Catch::Contains("expected SCHED_OTHER, SCHED_FIFO or SCHED_RR"));
}

TEST_CASE("a component profile lists ports and the files of types") {
    const Folder folder;
    const auto file = folder.write(
        "C.xml",
        "<component_profile><name>C</name><execution_environment><library_name>C</library_name>"
        "</execution_environment><execution_semantics><type>passive</type></execution_semantics>"
        "<ports><data_port><name>a</name><usage>input</usage><data_type>double</data_type>"
        "<queueing_policy>LIFO</queueing_policy><queue_size>4</queue_size></data_port>"
        "<data_port><name>b</name><usage>output</usage></data_port>"
        "<data_port><name>c</name><usage>output1</usage></data_port>"
        "<event_port><name>e</name><usage>input</usage><data_type>string</data_type></event_port>"
        "<service_port><name>s</name><type>Arm</type><usage>provided</usage>"
        "<reference>Arm.xml</reference></service_port></ports><defined_data_types>"
        "<defined_data_type>Point.xml</defined_data_type></defined_data_types><defined_service_types>"
        "<defined_service_type>Arm.xml</defined_service_type></defined_service_types>"
        "</component_profile>");
    const auto profile = read_component_profile(file);
    REQUIRE(profile.data_ports.size() == 2);
    CHECK(profile.data_ports[0].is_input);
    REQUIRE(profile.data_ports[0].queue);
    CHECK(profile.data_ports[0].queue->policy == OPROS_LIFO);
    CHECK(profile.data_ports[0].queue->size == 4);
    CHECK_FALSE(profile.data_ports[1].queue);
    REQUIRE(profile.event_ports.size() == 1);
    CHECK(profile.event_ports[0].is_input);
    REQUIRE(profile.service_ports.size() == 1);
    CHECK(profile.service_ports[0].is_provided);
    CHECK(profile.service_ports[0].reference == "Arm.xml");
    CHECK(profile.data_types == std::vector<std::string>{"Point.xml"});
    CHECK(profile.service_types == std::vector<std::string>{"Arm.xml"});
}

TEST_CASE("values that a profile chooses from a list may be in either case") {
    const Folder folder;
    const auto component = read_component_profile(folder.write(
        "C.xml",
        "<component_profile><name>C</name><execution_environment><library_name>C</library_name>"
        "</execution_environment><execution_semantics><type>Periodic-Shared</type><period>1</period>"
        "<policy>Sched_Fifo</policy></execution_semantics><ports>"
        "<data_port><name>a</name><usage>Input</usage><queueing_policy>Last</queueing_policy></data_port>"
        "<event_port><name>e</name><usage>OUTPUT</usage></event_port>"
        "<service_port><name>s</name><type>Arm</type><usage>Provided</usage></service_port>"
        "</ports></component_profile>"));
    CHECK(component.execution_type == ExecutionType::periodic_shared);
    CHECK(component.scheduling_policy == SchedulingPolicy::fifo);
    CHECK(component.port_errors.empty());
    REQUIRE(component.data_ports.size() == 1);
    CHECK(component.data_ports[0].is_input);
    REQUIRE(component.data_ports[0].queue);
    CHECK(component.data_ports[0].queue->policy == OPROS_LAST);
    REQUIRE(component.event_ports.size() == 1);
    CHECK_FALSE(component.event_ports[0].is_input);
    REQUIRE(component.service_ports.size() == 1);
    CHECK(component.service_ports[0].is_provided);
    const auto application = read_application_profile(
        folder.application(Folder::sub("A", "A.xml"), Folder::connect("Service", "A", "x", "A", "y")));
    REQUIRE(application.connections.size() == 1);
    CHECK(application.connections[0].error.empty());
    CHECK(application.connections[0].type == OPROS_SERVICE);
}

TEST_CASE("wrong queue settings are an error that quotes them") {
    const auto queue_error = [](const std::string& queue) {
        return component_error("<component_profile><name>C</name><execution_environment><library_name>C"
                               "</library_name></execution_environment><execution_semantics>"
                               "<type>passive</type></execution_semantics>\n<ports><data_port><name>a</name>"
                               "<usage>input</usage>\n" +
                               queue + "</data_port></ports></component_profile>");
    };
    CHECK_THAT(queue_error("<queueing_policy>SOME</queueing_policy>"),
               Catch::Contains("c.xml:3: <queueing_policy> is 'SOME', expected FIFO, LIFO, UFIFO or LAST"));
    CHECK_THAT(queue_error("<queue_size>0</queue_size>"), Catch::Contains("c.xml:3: a queue has 1 to"));
    CHECK_THAT(queue_error("<queue_size>1e9</queue_size>"), Catch::Contains("c.xml:3: a queue has 1 to"));
    CHECK_THAT(queue_error("<policy_param name=\"size\">many</policy_param>"),
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
    CHECK_THAT(read(Folder::sub(std::string(256, 'A'), "A.xml"), ""),
               Catch::Contains("app.xml:4: a component's name or reference has more than 255 bytes"));
    const auto connections =
        read_application_profile(folder.application(a, "<port_connection port_type=\"data\"/>")).connections;
    REQUIRE(connections.size() == 1);
    CHECK(connections[0].error == "<port_connection> lacks its <source>");
}

TEST_CASE("backslashes separate folders in profiles") {
    const Folder folder;
    folder.component("A", ".\\lib\\A.dll");
    CHECK(read_component_profile(folder.path() / "A.xml").library_name == "./lib/A.dll");
    const auto file = folder.application(Folder::sub("A", "..\\x\\A.xml"));
    CHECK(read_application_profile(file).subcomponents[0].reference == "../x/A.xml");
}

TEST_CASE("components start last listed first, but never before those they depend on") {
    ApplicationProfile profile;
    for (const char* name : {"A", "B", "C"}) profile.subcomponents.push_back({{}, name, "", {}, {}});
    CHECK(start_order(profile) == std::vector<std::string>{"C", "B", "A"});
    profile.dependencies = {{{}, "C", "A"}};
    CHECK(start_order(profile) == std::vector<std::string>{"B", "A", "C"});
    profile.dependencies.push_back({{}, "A", "C"});
    CHECK_THAT(error_of([&] { start_order(profile); }), Catch::Contains("circular dependency"));
}

TEST_CASE("a component profile is found in every layout in use") {
    const std::string where = GENERATE("A/", "app/", "");
    const Folder folder;
    folder.write(where + "A.xml", "");
    const auto profile = read_application_profile(folder.application(Folder::sub("A", "A.xml")));
    CHECK(find_component_profile(profile, profile.subcomponents[0], {}) == folder.path() / where / "A.xml");
}

TEST_CASE("a component profile in another case is found unless there is one in the same case") {
    const Folder folder;
    folder.write("A/ARM.XML", "");
    const auto profile = read_application_profile(folder.application(Folder::sub("A", "Arm.xml")));
    CHECK(find_component_profile(profile, profile.subcomponents[0], {}) == folder.path() / "A/ARM.XML");
    folder.write("Arm.xml", "");
    CHECK(find_component_profile(profile, profile.subcomponents[0], {}) == folder.path() / "Arm.xml");
}

TEST_CASE("a component profile that is not found is an error at the line that refers to it") {
    const Folder folder;
    const auto profile = read_application_profile(folder.application(Folder::sub("A", "A.xml")));
    CHECK_THAT(error_of([&] { find_component_profile(profile, profile.subcomponents[0], {"/plugins"}); }),
               Catch::Contains("app.xml:4") && Catch::Contains("/plugins/A.xml"));
    const auto absolute = read_application_profile(folder.application(Folder::sub("A", "/none/A.xml")));
    CHECK_THAT(error_of([&] { find_component_profile(absolute, absolute.subcomponents[0], {"/plugins"}); }),
               Catch::EndsWith(": looked for /none/A.xml"));
}

TEST_CASE("a profile that is not a readable file is an error that says why") {
    const Folder folder;
    const auto read = [](const std::filesystem::path& file) {
        return error_of([&] { read_component_profile(file); });
    };
    std::filesystem::create_symlink("loop.xml", folder.path() / "loop.xml");
    CHECK_THAT(read(folder.path()), Catch::Contains("cannot be read: it is not a file"));
    CHECK_THAT(read(folder.path() / "none.xml"), Catch::Contains("cannot be read: no such file"));
    CHECK_THAT(read(folder.path() / "loop.xml"), Catch::Contains("cannot be read: Too many levels"));
}
