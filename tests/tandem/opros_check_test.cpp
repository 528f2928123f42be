// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"
#include "tests/opros/folder.hpp"

#include <algorithm>

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
    CHECK(result.says("app: 2 components and 2 connections fit"));
}

TEST_CASE("tandem opros check tells every fault of an application in a line of its own") {
    const Folder folder;
    folder.component("M", "maker");
    folder.component("P", "printer");
    folder.component("Crash", ZOO "/opros/entry_crashes.so");
    folder.component("Lost", "nothing.dll");
    folder.component("Slow", "maker", "<type>periodic</type>");
    folder.component("Foreign", PLUGINS "/rtm/HWComp.so");
    const auto result = check(folder.application(
        Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml") + Folder::sub("Crash", "Crash.xml") +
            Folder::sub("Lost", "Lost.xml") + Folder::sub("Slow", "Slow.xml") +
            Folder::sub("Nobody", "Nobody.xml") + Folder::sub("Foreign", "Foreign.xml"),
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
    CHECK(result.says("Crash.xml:3: library " ZOO "/opros/entry_crashes.so "));
    CHECK(result.says("Lost.xml:3: library 'nothing.dll' not found"));
    CHECK(result.says("a periodic component needs a <period>"));
    CHECK(result.says("profile 'Nobody.xml' of component 'Nobody' not found"));
    CHECK(result.says("is an RTC module (exports HWCompInit)"));
    CHECK(result.says("app.xml:8: component 'M' has no port 'nope'"));
    CHECK(result.says("app.xml:9: type mismatch"));
    CHECK(result.says("app.xml:10: "));
    CHECK(result.says("app: 9 faults\n"));
    CHECK(std::count(result.output.begin(), result.output.end(), '\n') == 10);
    const auto json =
        tandem_program({"opros", "check", folder.path() / "app.xml", "--plugin-path", FIXTURES, "--json"});
    CHECK(json.exit_code == 1);
    CHECK(json.json()["faults"].size() == 9);
}

TEST_CASE("tandem opros check refuses a file that is no application in one line") {
    const Folder folder;
    const auto result = check(folder.write("bad.xml", "<package_profile>\n<name>x</nam>"));
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.errors, Catch::StartsWith("tandem: ") && Catch::Contains("bad.xml:2: not well-formed"));
}
