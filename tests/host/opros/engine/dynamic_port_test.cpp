// SPDX-License-Identifier: Apache-2.0
#include "tests/host/opros/engine/running.hpp"

#include <algorithm>

using tandem::engine::Application;

namespace {
bool has(const Recorder& recorder, const std::string& call) {
    return std::find(recorder.calls.begin(), recorder.calls.end(), call) != recorder.calls.end();
}
std::filesystem::path with_bridge(const Folder& folder, const std::string& connections,
                                  const std::string& bridge_properties = "") {
    folder.component("M", "maker", "<type>passive</type>", "<property name=\"calls\">yes</property>");
    folder.component("P", "printer");
    folder.component("B", "bridge", "<type>passive</type>", bridge_properties);
    return folder.application(
        Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml") + Folder::sub("B", "B.xml"), connections);
}
} // namespace

TEST_CASE("a bridge's input learns the type at connection and gets every value") {
    const Folder folder;
    Application application(with_bridge(folder, Folder::connect("data", "M", "numbers", "B", "in") +
                                                    Folder::connect("service", "M", "math", "P", "math")),
                            test_options(folder));
    CHECK(has(recorder(application, "B"), "input learns std::vector<double>"));
    application.start();
    application.step("M");
    CHECK(has(recorder(application, "B"), "input takes std::vector<double>"));
}

TEST_CASE("a bridge's output learns the type of the port it is connected to and feeds it") {
    const Folder folder;
    Application application(with_bridge(folder, Folder::connect("data", "B", "out", "P", "numbers")),
                            test_options(folder));
    CHECK(has(recorder(application, "B"), "output learns std::vector<double>"));
    application.start();
    application.step("B");
    application.step("P");
    CHECK(recorder(application, "P").last_number == 7);
}

TEST_CASE("the reason of a bridge that refuses a type is part of the error") {
    const Folder folder;
    const auto file = with_bridge(folder, Folder::connect("data", "B", "out", "P", "numbers"),
                                  "<property name=\"only\">float</property>");
    CHECK_THAT(
        setup_error(file, test_options(folder)),
        Catch::Contains(
            "output B.out is of any type, input P.numbers is std::vector<double>; the link has float"));
}

TEST_CASE("a dynamic provided port gets the required methods and then the calls, in the caller's thread") {
    const Folder folder;
    Application application(with_bridge(folder, Folder::connect("service", "M", "math", "B", "provided")),
                            test_options(folder));
    for (const char* name : {"bound add", "bound turn", "bound note"})
        CHECK(has(recorder(application, "B"), name));
    application.start();
    application.step("M");
    CHECK(recorder(application, "M").last_number == 10);
}

TEST_CASE("a dynamic required port gets the provided port at connection") {
    const Folder folder;
    Application application(with_bridge(folder, Folder::connect("service", "B", "required", "P", "math")),
                            test_options(folder));
    for (const char* name : {"sees add", "sees turn", "sees note"})
        CHECK(has(recorder(application, "B"), name));
}
