// SPDX-License-Identifier: Apache-2.0
#include "tests/apps/tandem/program.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

using tandem::test::tandem_program;

namespace {
tandem::test::Result check(const std::filesystem::path& application) {
    return tandem_program({"opros", "check", application, "--plugin-path", FIXTURES});
}
} // namespace

TEST_CASE("tandem opros check finds nothing in an application that fits") {
    const Folder folder;
    folder.component("M", "maker.dll");
    folder.component("P", "printer");
    const auto result = check(folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml"),
                                                 Folder::connect("data", "M", "numbers", "P", "numbers") +
                                                     Folder::connect("service", "M", "math", "P", "math")));
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    CHECK(result.output_contains("app: 2 components and 2 connections fit"));
}

TEST_CASE("tandem opros check prints one line for each error of an application") {
    const Folder folder;
    folder.component("M", "maker");
    folder.component("P", "printer");
    folder.component("Crash", ZOO "/opros/entry_crashes.so");
    folder.component("Lost", "nothing.dll");
    folder.component("Slow", "maker", "<type>periodic</type>");
    folder.component("Foreign", PLUGINS "/rtm/HWComp.so");
    folder.component("Old", ZOO "/opros/another_tandem.so");
    const auto result =
        check(folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml") +
                                     Folder::sub("Crash", "Crash.xml") + Folder::sub("Lost", "Lost.xml") +
                                     Folder::sub("Slow", "Slow.xml") + Folder::sub("Nobody", "Nobody.xml") +
                                     Folder::sub("Foreign", "Foreign.xml") + Folder::sub("Old", "Old.xml"),
                                 Folder::connect("data", "M", "numbers", "P", "numbers") +
                                     Folder::connect("data", "M", "nope", "P", "numbers") +
                                     Folder::connect("data", "M", "words", "P", "numbers") +
                                     Folder::connect("event", "M", "numbers", "P", "numbers") +
                                     Folder::connect("data", "Crash", "x", "P", "numbers"),
                                 "<coordination><depends source=\"M\" target=\"P\"/><depends source=\"P\" "
                                 "target=\"M\"/></coordination>"));
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(result.errors.empty());
    CHECK(result.output_contains("Crash.xml:3: library " ZOO "/opros/entry_crashes.so "));
    CHECK(result.output_contains("Lost.xml:3: library 'nothing.dll' not found"));
    CHECK(result.output_contains("a periodic component needs a <period>"));
    CHECK(result.output_contains("profile 'Nobody.xml' of component 'Nobody' not found"));
    CHECK(result.output_contains("is an RTC module (exports HWCompInit)"));
    CHECK(result.output_contains("Old.xml:3: library " ZOO
                                 "/opros/another_tandem.so was built against the headers of another"));
    CHECK(result.output_contains("app.xml:8: component 'M' has no port 'nope'"));
    CHECK(result.output_contains("app.xml:9: type mismatch"));
    CHECK(result.output_contains("app.xml:10: "));
    CHECK(result.output_contains("app: 10 errors\n"));
    CHECK(std::count(result.output.begin(), result.output.end(), '\n') == 11);
    const auto json =
        tandem_program({"opros", "check", folder.path() / "app.xml", "--plugin-path", FIXTURES, "--json"});
    CHECK(json.exit_code == 1);
    CHECK(json.json()["errors"].size() == 10);
}

TEST_CASE("tandem opros check and info report errors in properties") {
    const Folder folder;
    folder.component(
        "M", "maker", "<type>passive</type>",
        "<property name=\"Size\" type=\"int\">three</property><property name=\"troubel\">call</property>");
    const auto application = folder.application(Folder::sub("M", "M.xml"));
    const auto unread = check(application);
    CHECK(unread.exit_code == 1);
    CHECK(unread.output_contains("M.xml:5: property Size is 'three', expected a whole number (type int)\n"));
    CHECK(unread.output_contains("app: 1 error\n"));
    const auto asked =
        tandem_program({"opros", "check", application, "--plugin-path", FIXTURES, "--initialize"});
    INFO(asked.output << asked.errors);
    CHECK(asked.output_contains(
        "component M asks for property trouble, which its profile does not have; it gets an empty "
        "text; did you mean troubel?\n"));
    CHECK(asked.output_contains(
        "component M asks for property a, which its profile does not have; it gets an empty text\n"));
    CHECK_THAT(asked.output, Catch::Contains("app: 2 errors; ") && Catch::Contains(" note"));
    const auto info =
        tandem_program({"opros", "info", folder.path() / "M.xml", "--plugin-path", FIXTURES, "--initialize"});
    CHECK(info.exit_code == 0);
    CHECK(info.output_contains("M.xml:5: property Size is 'three', expected a whole number (type int)\n"));
    CHECK(info.output_contains("did you mean troubel?\n"));
}

TEST_CASE("tandem opros check fails for values that a component would read as 0 or not at all") {
    const Folder folder;
    const auto checked = [&](const std::string& properties, const std::string& overrides = "") {
        folder.component("M", "maker", "<type>passive</type>", properties);
        return check(folder.application(Folder::sub("M", "M.xml", overrides)));
    };
    const std::string gain = "<property name=\"gain\" type=\"double\">", end = "</property>";
    for (const auto& [properties, overrides, line] :
         {std::tuple{gain + end, std::string(),
                     "M.xml:5: property gain is '', expected a number (type double)\n"},
          {gain + "<value>5</value>" + end, "", "M.xml:5: property gain has its value in <value>, expected "},
          {gain + "5" + end + gain + "6" + end, "",
           "M.xml:5: 'property gain' is already in line 5; the last one is used"},
          {gain + "5" + end, "<properties>" + gain + end + "</properties>",
           "app.xml:4: component 'M': property gain is '', expected a number (type double)\n"},
          {gain + "5" + end, "<property name=\"gain\">7</property>",
           "app.xml:4: <property> has no effect in <subcomponent>; move it into <properties>\n"}}) {
        const auto result = checked(properties, overrides);
        INFO(result.output << result.errors);
        CHECK(result.exit_code == 1);
        CHECK_THAT(result.output, Catch::Contains(line));
    }
    CHECK(checked(gain + end, "<properties>" + gain + "5" + end + "</properties>").exit_code == 0);
}

TEST_CASE("tandem opros check reads the type profiles that a component refers to, if they are there") {
    const Folder folder;
    folder.write("P.xml",
                 "<component_profile><name>P</name><execution_environment><library_name>printer"
                 "</library_name></execution_environment><execution_semantics><type>passive</type>"
                 "</execution_semantics><data_type_list><reference>Points.xml</reference>"
                 "<reference>Lost.xml</reference></data_type_list><ports><service_port><name>math</name>"
                 "<type>Math</type><usage>provided</usage><reference>Math.xml</reference></service_port>"
                 "</ports></component_profile>");
    const auto application = folder.application(Folder::sub("P", "P.xml"));
    CHECK(check(application).exit_code == 0);
    folder.write("Math.xml", "<service_port_type_profile>\n<service_port_type><type_name>Math</type_name>\n"
                             "<method/></service_port_type></service_port_type_profile>");
    folder.write("Points.xml", "<data_type>\n</data_type>");
    const auto result = check(application);
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Catch::Contains("note: ") && Catch::Contains("Math.xml:3: "));
    CHECK(result.output_contains("Points.xml:1: <data_type> lacks its <struct>\n"));
    CHECK(result.output_contains("app: 1 component and 0 connections fit; 2 notes\n"));
}

TEST_CASE("tandem opros check notes where a service profile differs from the component's methods") {
    const Folder folder;
    folder.write("P.xml", "<component_profile><name>P</name><execution_environment><library_name>printer"
                          "</library_name></execution_environment><execution_semantics><type>passive</type>"
                          "</execution_semantics><ports><service_port><name>math</name><type>Math</type>"
                          "<usage>provided</usage><reference>Math.xml</reference></service_port>"
                          "</ports></component_profile>");
    folder.write("Math.xml",
                 "<service_port_type_profile><service_port_type><type_name>Math</type_name>\n"
                 "<method name=\"add\" return_type=\"double\"><param><type>double</type></param>"
                 "<param><type>const double&amp;</type></param></method>\n"
                 "<method name=\"note\" return_type=\"void\"><param><type>int</type></param></method>\n"
                 "<method name=\"fly\"/>\n</service_port_type></service_port_type_profile>");
    const auto result = check(folder.application(Folder::sub("P", "P.xml")));
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 0);
    CHECK(result.output_contains(
        "Math.xml:3: method 'note' is void(int) here, void(string) in the component's port 'math'\n"));
    CHECK(result.output_contains("Math.xml:4: service port 'math' of the component has no method 'fly'\n"));
    CHECK(result.output_contains(
        "Math.xml:1: method 'turn' of the component's port 'math' is not in this profile\n"));
    CHECK_FALSE(result.output_contains("'add'"));
}

TEST_CASE("tandem opros check reports a connection that is listed many times in one line") {
    const Folder folder;
    folder.component("M", "maker");
    folder.component("P", "printer");
    std::string connections;
    for (int i = 0; i < 6000; ++i) connections += Folder::connect("data", "M", "numbers", "P", "numbers");
    const auto result =
        check(folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml"), connections));
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(result.output_contains(
        "app.xml:8: connection M.numbers -> P.numbers is listed 6000 times, first at "));
    CHECK(result.output_contains("app: 1 error\n"));
}

TEST_CASE("tandem opros check reports a wrong connection that is listed many times in one line") {
    const Folder folder;
    folder.component("M", "maker");
    std::string connections;
    for (int i = 0; i < 3000; ++i)
        connections += Folder::connect("data", "M", "numbers", "Q", "numbers") +
                       Folder::connect("mail", "M", "news", "M", "news");
    const auto result = check(folder.application(Folder::sub("M", "M.xml"), connections));
    INFO(result.output << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(result.output_contains(
        "app.xml:7: unknown component 'Q', expected one of M, in a connection that is listed 3000 times\n"));
    CHECK(result.output_contains("app.xml:8: port_type is 'mail'"));
    CHECK(result.output_contains("app: 2 errors\n"));
}

TEST_CASE("tandem opros check refuses a file that is not an application in one line") {
    const Folder folder;
    const auto result = check(folder.write("bad.xml", "<package_profile>\n<name>x</nam>"));
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.errors, Catch::StartsWith("tandem: ") && Catch::Contains("bad.xml:2: not well-formed"));
}

TEST_CASE("tandem opros check compares the ports that a profile lists with those of the component") {
    const Folder folder;
    const auto port = [](const std::string& kind, const std::string& name, const std::string& usage,
                         const std::string& type) {
        return "<" + kind + "_port><name>" + name + "</name><usage>" + usage + "</usage><data_type>" + type +
               "</data_type></" + kind + "_port>\n";
    };
    const auto checked = [&](const std::string& ports) {
        folder.write("P.xml",
                     "<component_profile>\n<name>P</name>\n<execution_environment><library_name>printer"
                     "</library_name></execution_environment>\n<execution_semantics><type>passive"
                     "</type></execution_semantics>\n<ports>\n" +
                         ports + "</ports>\n</component_profile>\n");
        return check(folder.application(Folder::sub("P", "P.xml")));
    };
    const auto fits = checked(port("data", "numbers", "input", "vector&lt; double &gt;") +
                              port("data", "counts", "input", "") + port("event", "news", "input", "string") +
                              port("service", "math", "provided", ""));
    INFO(fits.output << fits.errors);
    CHECK(fits.exit_code == 0);
    const auto unfit =
        checked(port("data", "numbers", "input", "vector&lt;int&gt;") +
                port("data", "counts", "output", "int") + port("data", "news", "input", "string") +
                port("service", "maths", "provided", "") + port("data", "more", "input1", ""));
    INFO(unfit.output << unfit.errors);
    CHECK(unfit.exit_code == 0);
    CHECK(unfit.output_contains(
        "P.xml:6: data port 'numbers' is std::vector<double> in the component, not vector<int>\n"));
    CHECK(unfit.output_contains("P.xml:7: data port 'counts' is input in the component, not output\n"));
    CHECK(unfit.output_contains("P.xml:8: data port 'news' has kind event in the component\n"));
    CHECK(unfit.output_contains("P.xml:9: service port 'maths' does not exist in the component; its service "
                                "ports are: math (to see"));
    CHECK(unfit.output_contains(
        "P.xml:10: <data_port> 'more' has the <usage> 'input1', expected input or output\n"));
    CHECK(unfit.output_contains("app: 1 component and 0 connections fit; 5 notes\n"));
    CHECK(std::count(unfit.output.begin(), unfit.output.end(), '\n') == 6);
}
