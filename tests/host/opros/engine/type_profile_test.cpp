// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/profile_kind.hpp"
#include "host/opros/engine/profile/type_profile.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <catch2/catch.hpp>

using namespace tandem::engine;

namespace {
const std::string service_head =
    "<service_port_type_profile>\n<service_port_type>\n<type_name>Arm</type_name>\n";
const std::string service_foot = "</service_port_type></service_port_type_profile>";
} // namespace

TEST_CASE("a service type profile gives methods with their parameters in order") {
    const Folder folder;
    const auto file = folder.write(
        "s.xml", service_head +
                     "<method name=\"Move\" return_type=\"ReturnType\" call_type=\"blocking\">"
                     "<param index=\"2\"><name>t</name><type>double</type></param>"
                     "<param index=\"1\"><name>to</name><type>vector&lt;double&gt;</type></param>"
                     "</method><method name=\"Stop\"/>" +
                     service_foot);
    const auto types = read_service_type_profile(file);
    REQUIRE(types.size() == 1);
    CHECK(types[0].name == "Arm");
    REQUIRE(types[0].methods.size() == 2);
    const MethodProfile& move = types[0].methods[0];
    CHECK(move.return_type == "ReturnType");
    CHECK(move.call_type == "blocking");
    REQUIRE(move.parameters.size() == 2);
    CHECK(move.parameters[0].type == "vector<double>");
    CHECK(move.parameters[1].name == "t");
    CHECK(types[0].methods[1].return_type == "void");
    CHECK(read_profile_kind(file) == ProfileKind::service_type);
}

TEST_CASE("a data type profile gives structures with their fields") {
    const Folder folder;
    const auto file =
        folder.write("d.xml", "<data_type><struct name=\"Point\"><item type=\"double\">x</item>"
                              "<item type=\"std::string\" default=\"map\">frame</item></struct></data_type>");
    const auto types = read_data_type_profile(file);
    REQUIRE(types.size() == 1);
    CHECK(types[0].name == "Point");
    REQUIRE(types[0].fields.size() == 2);
    CHECK(types[0].fields[1].type == "std::string");
    CHECK(types[0].fields[1].default_value == "map");
    CHECK(read_profile_kind(file) == ProfileKind::data_type);
}

TEST_CASE("a wrong type profile gets one line with file and line") {
    const Folder folder;
    const auto service = [&](const std::string& methods) {
        const auto file = folder.write("s.xml", service_head + methods + service_foot);
        try {
            read_service_type_profile(file);
        } catch (const SetupError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    CHECK_THAT(service("<method/>"), Catch::Contains("s.xml:4: <method> lacks its attribute name"));
    CHECK_THAT(service("<method name=\"a\"/>\n<method name=\"a\"/>"),
               Catch::Contains("s.xml:5: method 'a' is listed twice"));
    CHECK_THAT(service("<method name=\"a\"><param/></method>"),
               Catch::Contains("s.xml:4: <param> lacks its <type>"));
    CHECK_THAT(service("<method name=\"a\">\n<param index=\"last\"/></method>"),
               Catch::Contains("s.xml:5: index of a <param> is 'last'"));
    const auto data = [&](const std::string& inside) {
        const auto file = folder.write("d.xml", "<data_type>\n" + inside + "</data_type>");
        try {
            read_data_type_profile(file);
        } catch (const SetupError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    CHECK_THAT(data(""), Catch::Contains("d.xml:1: <data_type> lacks its <struct>"));
    CHECK_THAT(data("<struct name=\"A\"><item type=\"int\"> </item></struct>"),
               Catch::Contains("d.xml:2: <item> lacks its text"));
    CHECK_THROWS_WITH(read_profile_kind(folder.write("x.xml", "<x/>")),
                      Catch::Contains("root element is <x>"));
}
