// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "tests/host/opros/engine/running.hpp"

using namespace tandem::engine;

namespace {

void composite(const Folder& folder, const std::string& name, const std::string& inside) {
    folder.write(name + ".xml", "<composite_component_profile>\n<name>" + name + "</name>\n" + inside +
                                    "</composite_component_profile>\n");
}

std::string subs(const std::string& inside) { return "<subcomponents>" + inside + "</subcomponents>\n"; }

std::string export_port(const std::string& type, const std::string& component, const std::string& port,
                        const std::string& name = "") {
    return "<export_port><component_name>" + component + "</component_name><port_name>" + port +
           "</port_name><port_type>" + type + "</port_type>" +
           (name.empty() ? "" : "<export_port_name>" + name + "</export_port_name>") + "</export_port>";
}

std::string exports(const std::string& inside) { return "<export_ports>" + inside + "</export_ports>\n"; }

std::string error_of(const Folder& folder, const std::filesystem::path& file) {
    return setup_error(file, test_options(folder));
}

/// A composite "Hands" of a maker and a printer, within a composite "Arm", and another printer outside.
std::filesystem::path arm(const Folder& folder) {
    folder.component("M", "maker", "<type>periodic</type><period>10</period>",
                     "<property name=\"calls\">yes</property>");
    folder.component("P", "printer");
    composite(folder, "Hands",
              subs(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml")) + "<port_connections>" +
                  Folder::connect("event", "M", "news", "P", "news") + "</port_connections>" +
                  exports(export_port("data", "M", "numbers", "out") + export_port("service", "M", "math") +
                          export_port("data", "P", "numbers", "in")));
    composite(folder, "Arm",
              subs(Folder::sub("H", "Hands.xml")) +
                  exports(export_port("data", "H", "out", "values") + export_port("service", "H", "math")));
    return folder.application(Folder::sub("A", "Arm.xml") + Folder::sub("P", "P.xml"),
                              Folder::connect("data", "A", "values", "P", "numbers") +
                                  Folder::connect("service", "A", "math", "P", "math"));
}

} // namespace

TEST_CASE("exported ports of nested composites are connected to the components' own ports") {
    const Folder folder;
    Application application(arm(folder), test_options(folder));
    application.start();
    application.step("A.H.M");
    application.step("P");
    CHECK(recorder(application, "P").last_number == 1);
    CHECK(recorder(application, "A.H.M").last_number == 1.5);
    CHECK(recorder(application, "A.H.P").last_event == "tick: cycle 1");
    CHECK(application.find_component("A.H.M")->component().getId() == "A.H.M");
}

TEST_CASE("the same composite may be used twice") {
    const Folder folder;
    arm(folder);
    const auto file = folder.application(Folder::sub("A", "Hands.xml") + Folder::sub("B", "Hands.xml") +
                                             Folder::sub("P", "P.xml"),
                                         Folder::connect("data", "A", "out", "B", "in") +
                                             Folder::connect("service", "A", "math", "P", "math"));
    Application application(file, test_options(folder));
    application.start();
    application.step("A.M");
    application.step("B.P");
    CHECK(recorder(application, "B.P").last_number == 1);
    CHECK(recorder(application, "A.P").last_number == -1);
}

TEST_CASE("a port that is connected under two exported names is an error") {
    const Folder folder;
    arm(folder);
    composite(folder, "Two",
              subs(Folder::sub("M", "M.xml")) + exports(export_port("data", "M", "numbers", "one") +
                                                        export_port("data", "M", "numbers", "other")));
    CHECK_THAT(
        error_of(folder, folder.application(Folder::sub("T", "Two.xml") + Folder::sub("P", "P.xml"),
                                            Folder::connect("data", "T", "one", "P", "numbers") +
                                                Folder::connect("data", "T", "other", "P", "numbers"))),
        Catch::Contains("app.xml:8: connection T.M.numbers -> P.numbers is listed 2 times"));
}

TEST_CASE("a dependency on a composite is one on each of its components") {
    const Folder folder;
    arm(folder);
    const auto file = folder.application(Folder::sub("P", "P.xml") + Folder::sub("A", "Hands.xml"), "",
                                         "<coordination><depends source=\"A\" target=\"P\"/></coordination>");
    const auto flat = flatten_composites(read_application_profile(file), {});
    REQUIRE(flat.dependencies.size() == 2);
    CHECK(flat.dependencies[0].source == "A.M");
    CHECK(flat.dependencies[1].source == "A.P");
    CHECK(flat.dependencies[1].target == "P");
}

TEST_CASE("a wrong composite is reported in one line with file and line") {
    const Folder folder;
    arm(folder);
    const auto connected = [&](const std::string& type, const std::string& port) {
        return error_of(folder, folder.application(Folder::sub("A", "Arm.xml") + Folder::sub("P", "P.xml"),
                                                   Folder::connect(type, "A", port, "P", "numbers")));
    };
    CHECK_THAT(connected("data", "numbers"),
               Catch::Contains(
                   "app.xml:7: composite 'A' exports no data port 'numbers', its data ports are: values"));
    CHECK_THAT(connected("event", "values"),
               Catch::Contains("exports no event port 'values'") && Catch::Contains("none"));
    const auto with_exports = [&](const std::string& inside) {
        composite(folder, "C", subs(Folder::sub("P", "P.xml")) + exports(inside));
        return error_of(folder, folder.application(Folder::sub("C", "C.xml")));
    };
    CHECK_THAT(with_exports(export_port("data", "X", "in")),
               Catch::Contains("C.xml:4: unknown component 'X'"));
    CHECK_THAT(with_exports(export_port("data", "P", "in") + export_port("data", "P", "other", "in")),
               Catch::Contains("C.xml:4: port 'in' is exported twice"));
    CHECK_THAT(with_exports("<export_port/>"), Catch::Contains("C.xml:4: <export_port> lacks its"));
    CHECK_THAT(with_exports(export_port("sound", "P", "in")), Catch::Contains("port_type is 'sound'"));
}

TEST_CASE("a composite that contains itself is refused") {
    const Folder folder;
    composite(folder, "A", subs(Folder::sub("B", "B.xml")));
    composite(folder, "B", subs(Folder::sub("A", "A.xml")));
    CHECK_THAT(error_of(folder, folder.application(Folder::sub("A", "A.xml"))),
               Catch::Contains("B.xml:3: composite") && Catch::Contains("contains itself"));
}

TEST_CASE("composites with too many components are refused") {
    const Folder folder;
    folder.component("P", "printer");
    std::string last = "P.xml";
    for (const char* name : {"A", "B", "C", "D"}) {
        std::string inside;
        for (int i = 0; i < 10; ++i) inside += Folder::sub(std::to_string(i), last);
        composite(folder, name, subs(inside));
        last = std::string(name) + ".xml";
    }
    CHECK_THAT(error_of(folder, folder.application(Folder::sub("D", "D.xml"))),
               Catch::Contains("more than 1000 components"));
}
