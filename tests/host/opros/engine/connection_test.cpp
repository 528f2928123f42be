// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/connect/service_connection.hpp"
#include "tests/host/opros/engine/running.hpp"
#include "tests/host/opros/fixtures/MathRequired.h"

#include <MethodInvokeException.h>

namespace {
std::string connection_error(const std::string& type, const std::string& from, const std::string& to) {
    const Folder folder;
    folder.component("M", "maker");
    folder.component("P", "printer");
    const std::string message =
        setup_error(folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml"),
                                       std::string("\n") + Folder::connect(type, "M", from, "P", to)),
                    test_options(folder));
    CHECK(message.find('\n') == std::string::npos);
    return message;
}
} // namespace

TEST_CASE("a port that does not exist is an error that lists those that do") {
    CHECK_THAT(
        connection_error("data", "number", "numbers"),
        Catch::Contains(
            "app.xml:8: component 'M' has no port 'number', its data ports are: numbers, poses, words"));
    CHECK_THAT(connection_error("event", "news", "paper"), Catch::Contains("its event ports are: news"));
}

TEST_CASE("a port of the wrong direction or kind is an error") {
    CHECK_THAT(connection_error("data", "news", "numbers"),
               Catch::Contains("app.xml:8: port M.news is an event port, not a data port"));
    CHECK_THAT(connection_error("service", "math", "numbers"),
               Catch::Contains("port P.numbers is a data port, not a service port"));
    CHECK_THAT(connection_error("data", "numbers", "words"), Catch::Contains("component 'P' has no port"));
}

TEST_CASE("ports of different types are not connected, and the error names both types") {
    CHECK_THAT(
        connection_error("data", "numbers", "counts"),
        Catch::Contains(
            "app.xml:8: type mismatch: output M.numbers is std::vector<double>, input P.counts is int"));
}

TEST_CASE("a method that the provided port lacks is an error") {
    const Folder folder;
    folder.component("M", "maker");
    const std::string message =
        setup_error(folder.application(Folder::sub("M", "M.xml"),
                                       Folder::connect("service", "M", "math", "M", "opros.symbol")),
                    test_options(folder));
    CHECK_THAT(message, Catch::Contains("app.xml:7: component 'M' has no port 'opros.symbol'"));
}

TEST_CASE("a connection of an unknown type is left out and the others are made") {
    const Folder folder;
    folder.component("M", "maker");
    folder.component("P", "printer");
    const auto file = folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml"),
                                         Folder::connect("method", "M", "math", "P", "math") +
                                             Folder::connect("", "M", "news", "P", "news") +
                                             Folder::connect("data", "M", "numbers", "P", "numbers"));
    CHECK_THAT(setup_error(file, test_options(folder)),
               Catch::Contains("app.xml:7: port_type is 'method', expected data, event or service"));
    tandem::engine::Application application(file, test_options(folder));
    application.start();
    application.step("M");
    application.step("P");
    CHECK(recorder(application, "P").last_number == 1);
    CHECK(recorder(application, "P").events == 0);
}

TEST_CASE("a connection without a port's name is left out and the others are made") {
    const Folder folder;
    folder.component("M", "maker");
    folder.component("P", "printer");
    const auto file =
        folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml"),
                           "<port_connection port_type=\"data\"><source component_name=\"M\"/>"
                           "<target component_name=\"P\" port_name=\"counts\"/></port_connection>\n" +
                               Folder::connect("data", "M", "numbers", "P", "numbers"));
    CHECK_THAT(setup_error(file, test_options(folder)),
               Catch::Contains("app.xml:7: <source> lacks its attribute port_name"));
    tandem::engine::Application application(file, test_options(folder));
    application.start();
    application.step("M");
    application.step("P");
    CHECK(recorder(application, "P").last_number == 1);
}

TEST_CASE("a connection that is listed again is one error with the line of the first, and values are "
          "delivered once") {
    const Folder folder;
    folder.component("M", "maker");
    folder.component("P", "printer");
    std::string connections = Folder::connect("data", "M", "numbers", "P", "numbers") +
                              Folder::connect("event", "M", "news", "P", "news");
    for (int i = 0; i < 3; ++i) connections += Folder::connect("event", "M", "news", "P", "news");
    const auto file = folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml"), connections);
    CHECK_THAT(setup_error(file, test_options(folder)),
               Catch::Contains("app.xml:9: connection M.news -> P.news is listed 4 times, first at ") &&
                   Catch::Contains("app.xml:8; "));
    tandem::engine::Application application(file, test_options(folder));
    application.start();
    for (int i = 0; i < 5; ++i) application.step("M");
    CHECK(recorder(application, "P").events == 5);
}

TEST_CASE("a second provider of a required port is an error") {
    const Folder folder;
    folder.component("M", "maker", "<type>passive</type>", "<property name=\"calls\">yes</property>");
    folder.component("P", "printer");
    const auto file =
        folder.application(Folder::sub("M", "M.xml") + Folder::sub("P", "P.xml") + Folder::sub("Q", "P.xml"),
                           Folder::connect("service", "M", "math", "P", "math") +
                               Folder::connect("service", "M", "math", "Q", "math"));
    CHECK_THAT(setup_error(file, test_options(folder)),
               Catch::Contains("app.xml:8: required port M.math is connected to P.math already, ") &&
                   Catch::Contains("app.xml:7; "));
    tandem::engine::Application application(file, test_options(folder));
    application.start();
    application.step("M");
    CHECK(recorder(application, "P").calls.size() == 1);
    CHECK(recorder(application, "Q").calls.empty());
}

namespace {
struct Notes {
    virtual ~Notes() = default;
    virtual void note(std::string) {}
};
} // namespace

TEST_CASE("a service connection that fails half-way leaves no method connected") {
    const Folder folder;
    folder.component("P", "printer");
    tandem::engine::Application application(folder.application(Folder::sub("P", "P.xml")),
                                            test_options(folder));
    application.start();
    Notes owner;
    ProvidedServicePort provided;
    provided.addMethod("note", makeProvidedMethod(&Notes::note, &owner, "note"));
    RequiredServicePort required; // note comes before what the provider lacks
    Method* note = makeRequiredMethod(&MathRequired::note, "note", METHOD_NONBLOCKING);
    required.addMethod("note", note);
    required.addMethod("turn", makeRequiredMethod(&MathRequired::turn, "turn"));
    CHECK_THROWS_WITH(tandem::engine::ServiceConnection(required, provided, *application.find_component("P")),
                      Catch::Contains("has no method 'turn'"));
    CHECK_THROWS_AS((*static_cast<RequiredMethod<void>*>(note))(std::string("lost")), MethodInvokeException);
}
