// SPDX-License-Identifier: Apache-2.0
// Properties of a profile that are missing, misspelt, or not of their type.
#include "host/opros/engine/load/absent_properties.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "tests/host/opros/engine/running.hpp"
#include "tests/support/comma_locale.hpp"

#include <algorithm>

namespace {

using Catch::Contains;
using Lines = std::vector<std::string>;

/// The lines about a component with these properties, without the folder at their beginning. Properties start in line 6.
Lines check(const Folder& folder, const std::string& properties) {
    folder.component("M", "maker", "<type>passive</type>", "\n" + properties);
    Lines lines = tandem::engine::check_properties(
        tandem::engine::read_component_profile(folder.path() / "M.xml"), {}, {folder.path()});
    for (std::string& line : lines) line = line.substr(line.find("M.xml"));
    return lines;
}

std::string property(const std::string& attributes, const std::string& value) {
    return "<property " + attributes + ">" + value + "</property>\n";
}

} // namespace

TEST_CASE("a property whose value does not fit its type is a line with its place and what was expected") {
    const Folder folder;
    CHECK(check(folder, property("name=\"Size\" type=\"int\"", "three") +
                            property("name=\"Gain\" type=\"double\"", "high") +
                            property("name=\"On\" type=\"bool\"", "maybe") + property("type=\"int\"", "1")) ==
          Lines{"M.xml:6: property Size is 'three', expected a whole number (type int)",
                "M.xml:7: property Gain is 'high', expected a number (type double)",
                "M.xml:8: property On is 'maybe', expected true or false (type bool)",
                "M.xml:9: <property> lacks its attribute name"});
}

TEST_CASE("a value with a decimal point is a number, whatever locale a component has set") {
    const Folder folder;
    const tandem::test::CommaLocale locale;
    CHECK(check(folder, property("name=\"Gain\" type=\"double\"", "0.5")).empty());
}

TEST_CASE("the property values of OPRoS's own components fit their types") {
    const Folder folder;
    CHECK(check(folder, property("name=\"X0\" type=\"double\"", " 0.0 ") +
                            property("name=\"X\" type=\"int\"", "-50.0") +
                            property("name=\"N\" type=\"unsigned long\"", "0") +
                            property("name=\"On\" type=\"bool\"", "True") +
                            property("name=\"S\" type=\"string\"", "a b") +
                            property("name=\"V\" type=\"vector<int>\"", "1 2") +
                            property("name=\"U\"", "anything") + property("name=\"T\" type=\"string\"", "") +
                            property("name=\"MapName\" type=\"string\"", "lab"))
              .empty());
}

TEST_CASE("an empty value is valid only as text") {
    const Folder folder;
    CHECK(check(folder, property("name=\"E\" type=\"int\"", "") +
                            property("name=\"D\" type=\"double\"", " ") +
                            property("name=\"B\" type=\"bool\"", "")) ==
          Lines{"M.xml:6: property E is '', expected a whole number (type int)",
                "M.xml:7: property D is '', expected a number (type double)",
                "M.xml:8: property B is '', expected true or false (type bool)"});
}

TEST_CASE("a value that is not the text of its property is named") {
    const Folder folder;
    CHECK(
        check(folder,
              "<property name=\"A\" value=\"5\"/>\n<property name=\"B\"><value>5</value></property>\n") ==
        Lines{
            "M.xml:6: property A has its value in the attribute value, expected <property "
            "name=\"A\">VALUE</property>",
            "M.xml:7: property B has its value in <value>, expected <property name=\"B\">VALUE</property>"});
}

TEST_CASE("a repeated or misplaced element is reported, with the one that counts") {
    const Folder folder;
    CHECK(check(folder, property("name=\"A\"", "1") + property("name=\"A\"", "2") +
                            "</properties><properties>\n" + property("name=\"C\"", "1") + "</properties>\n" +
                            "<property name=\"D\">1</property><phase>5</phase><properties>\n") ==
          Lines{"M.xml:7: 'property A' is already in line 6; the last one is used; remove one",
                "M.xml:8: <properties> is already in line 5; this one has no effect; remove one",
                "M.xml:11: <property> has no effect in <component_profile>; move it into <properties>",
                "M.xml:11: <phase> has no effect in <component_profile>; move it into <execution_semantics>",
                "M.xml:11: <properties> is already in line 5; this one has no effect; remove one"});
    const auto profile = tandem::engine::read_component_profile(folder.write(
        "P.xml",
        "<component_profile><name>P</name><execution_environment><library_name>p</library_name>"
        "</execution_environment><execution_semantics><type>passive</type><priority/></execution_semantics>"
        "<defined_data_types><type>a.xml</type><type>b.xml</type></defined_data_types>\n<ports>"
        "<data_port><name>a</name><usage>input</usage></data_port>\n"
        "<data_port><name>a</name><usage>input</usage><usage>output</usage></data_port>"
        "<event_port><name>a</name><usage>input</usage></event_port></ports></component_profile>"));
    REQUIRE(profile.structure_errors.size() == 3);
    CHECK_THAT(profile.structure_errors[0],
               Catch::EndsWith("<priority> is empty, expected a number; remove it to use "
                               "the default"));
    CHECK_THAT(profile.structure_errors[1], Contains("P.xml:3: 'data_port a' is already in line 2"));
    CHECK_THAT(profile.structure_errors[2], Contains("<usage> is already in line"));
}

TEST_CASE("an element that the list around it does not know is reported") {
    const Folder folder;
    CHECK(check(folder, "<proprety name=\"A\">1</proprety>\n") ==
          Lines{"M.xml:6: <proprety> is unknown in <properties>, expected <property>"});
    CHECK(check(folder, "</properties><ports><data_prot/></ports><properties>\n") ==
          Lines{"M.xml:6: <data_prot> is unknown in <ports>, expected <data_port> or <event_port> or "
                "<service_port>",
                "M.xml:6: <properties> is already in line 5; this one has no effect; remove one"});
}

TEST_CASE("a profile that is nested without end or repeats an element many times gets at most 100 lines") {
    const Folder folder;
    std::string deep, properties;
    for (int i = 0; i < 100'000; ++i) deep += "<a>";
    for (int i = 0; i < 100'000; ++i) deep += "</a>";
    for (int i = 0; i < 1000; ++i) properties += property("name=\"A\"", "1");
    CHECK(check(folder, properties + "</properties>" + deep + "<properties>\n").size() == 100);
}

TEST_CASE("a value that the application sets counts in place of the profile's, and must be of its type") {
    const Folder folder;
    folder.component("M", "maker", "<type>passive</type>", property("name=\"Gain\" type=\"double\"", ""));
    const auto profile = tandem::engine::read_component_profile(folder.path() / "M.xml");
    tandem::engine::Subcomponent entry{{"app.xml", 3}, "Maker", "M.xml", {{"Gain", " 2.5 "}}, {}};
    CHECK(tandem::engine::check_properties(profile, entry, {}).empty());
    entry.properties[0].second = "2,5";
    CHECK(tandem::engine::check_properties(profile, entry, {}) ==
          Lines{"app.xml:3: component 'Maker': property Gain is '2,5', expected a number (type double)"});
}

TEST_CASE("a property of the application is named if it resembles one that only the profile has") {
    const Folder folder;
    folder.component("M", "maker", "<type>passive</type>", property("name=\"Gain\" type=\"double\"", "1"));
    const auto profile = tandem::engine::read_component_profile(folder.path() / "M.xml");
    tandem::engine::Subcomponent entry{{"app.xml", 3}, "Maker", "M.xml", {{"Gian", "2.5"}}, {}};
    CHECK(tandem::engine::check_properties(profile, entry, {}) ==
          Lines{"app.xml:3: component 'Maker': M.xml has no property Gian; did you mean Gain?"});
    entry.properties.emplace_back("Gain", "2.5");
    CHECK(tandem::engine::check_properties(profile, entry, {}).empty());
    entry.properties = {{"Threshold", "1"}, {"Gain2", "1"}};
    CHECK(tandem::engine::check_properties(profile, entry, {}).empty());
}

TEST_CASE("a misspelt property or device library is named with what was probably meant") {
    const Folder folder;
    const Lines api = check(folder, property("name=\"Api\" type=\"Name\"", "EncoderApi"));
    REQUIRE(api.size() == 2);
    CHECK(api[0] ==
          "M.xml:6: property Api has the unknown type 'Name', expected int, double, string, bool or another "
          "type of C++");
    CHECK(api[1] ==
          "M.xml:6: property Api: components ask for their device library as APIName, ApiName or DllName; "
          "did you mean ApiName?");
    folder.write("GripperAPI.so", "");
    const Lines library = check(folder, property("name=\"DllName\" type=\"string\"", "GriiperAPI"));
    REQUIRE(library.size() == 1);
    CHECK_THAT(library[0],
               Catch::StartsWith("M.xml:6: property DllName: device library 'GriiperAPI' not found: ") &&
                   Catch::EndsWith("; did you mean GripperAPI?"));
    CHECK(check(folder, property("name=\"DllName\" type=\"string\"", "GripperAPI")).empty());
}

TEST_CASE("a property that a component asks for and its profile does not have is noted once") {
    const Folder folder;
    folder.component("Asking", "maker", "<type>passive</type>", "<property name=\"troubel\">call</property>");
    tandem::engine::Application application(folder.application(Folder::sub("Asking", "Asking.xml")),
                                            test_options(folder));
    application.start();
    application.step("Asking");
    application.step("Asking");
    Lines lines;
    for (const auto& absent : tandem::engine::absent_properties()) lines.push_back(absent.line);
    CHECK(std::count(lines.begin(), lines.end(),
                     "component Asking asks for property trouble, which its profile does not have; it gets "
                     "an empty text; "
                     "did you mean troubel?") == 1);
    CHECK(
        std::count(
            lines.begin(), lines.end(),
            "component Asking asks for property a, which its profile does not have; it gets an empty text") ==
        1);
}
