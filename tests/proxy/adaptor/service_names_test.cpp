// SPDX-License-Identifier: Apache-2.0
// Service ports whose methods have other names than the operations of the peer.
#include "provided_port_connector.hpp"
#include "proxy/adaptor/service/mirror_provided_port.hpp"
#include "proxy/adaptor/service/mirror_required_port.hpp"
#include "tests/proxy/link/link_side.hpp"

#include <catch2/catch.hpp>

#include <ProvidedMethod.h>
#include <RequiredMethod.h>

using namespace tandem;
using namespace std::chrono_literals;
using link::CallStatus;
using link::Reply;
using link::test::eventually;
using link::test::soon;

namespace {

const link::Port greeter_port{link::PortKind::service_provided,
                              "greeter",
                              "Greeter",
                              "",
                              "greeter",
                              {{"echo", "s:s"}, {"tell", "s:s"}, {"halt", ":"}, {"level", ">d:"}}};

/// A component that was written without knowledge of Greeter.
class PrinterRequired : public RequiredServicePort {
  public:
    PrinterRequired() {
        addMethod("print", makeRequiredMethod(&PrinterRequired::print, "print"));
        addMethod("Stop", makeRequiredMethod(&PrinterRequired::Stop, "Stop"));
        addMethod("GetLevel", makeRequiredMethod(&PrinterRequired::GetLevel, "GetLevel"));
    }
    std::string print(std::string text) {
        return (*reinterpret_cast<RequiredMethod<std::string>*>(getMethod("print")))(text);
    }
    void Stop() { (*reinterpret_cast<RequiredMethod<void>*>(getMethod("Stop")))(); }
    double GetLevel() { return (*reinterpret_cast<RequiredMethod<double>*>(getMethod("GetLevel")))(); }
};

struct Printer {
    std::string print(std::string text) { return text + "!"; }
    std::string echo(std::string) { return "not meant"; }
    double GetLevel() { return 0.25; }
};

struct PrinterProvided : ProvidedServicePort {
    explicit PrinterProvided(Printer& printer) {
        addMethod("print", makeProvidedMethod(&Printer::print, &printer, "print"));
        addMethod("echo", makeProvidedMethod(&Printer::echo, &printer, "echo"));
        addMethod("GetLevel", makeProvidedMethod(&Printer::GetLevel, &printer, "GetLevel"));
    }
};

} // namespace

TEST_CASE("a method is called as the operation that the property names for it") {
    const auto name = link::test::unique_name("service-names");
    auto here = link::test::adaptor(name), peer = link::test::interceptor(name);
    adaptor::MirrorProvidedPort mirror(greeter_port, here->link, 5s,
                                       {"names.greeter", "print=tell, GetLevel=level"});
    ProvidedPortConnector connector(mirror);
    here->link.open();
    peer->link.open();
    here->link.wait_until_up(soon, "peer");
    std::string called;
    peer->on_call = [&](const link::Request& request) {
        called += std::string(request.operation) + " ";
        Reply reply;
        wire::CdrWriter out(reply.bytes);
        if (request.operation == "level")
            out.put(2.5);
        else
            out.put_string("told");
        return reply;
    };
    PrinterRequired required;
    CHECK(mirror.bindMethod(required.getMethod("print")) == "");
    CHECK(mirror.bindMethod(required.getMethod("GetLevel")) == "");
    CHECK_THAT(mirror.bindMethod(required.getMethod("Stop")),
               Catch::Contains("the peer's interface has no operation 'Stop'; halt has its types: set "
                               "AdaptorComp's property 'names.greeter' to Stop=halt if it is meant"));
    for (auto at = required.getFirst(); at != required.getEnd(); ++at)
        static_cast<RequiredMethodInterface&>(*at->second).Connect(&connector);
    CHECK(required.print("hello") == "told");
    CHECK(required.GetLevel() == 2.5); // the only out argument is the result
    CHECK(called == "tell level ");
}

TEST_CASE(
    "the peer's operation is the method that the property names for it, not the method of the same name") {
    Printer printer;
    PrinterProvided provided(printer);
    adaptor::MirrorRequiredPort mirror(greeter_port, [] {}, {"names.greeter", "print=echo,GetLevel=level"});
    REQUIRE(mirror.bindProvided(&provided) == "");
    std::vector<std::byte> arguments;
    wire::CdrWriter(arguments).put_string("hello");
    const auto echoed = mirror.serve({"greeter", "echo", "s:s", arguments});
    REQUIRE(echoed.status == CallStatus::ok);
    wire::CdrReader in(echoed.bytes);
    CHECK(in.get_string() == "hello!");
    const auto level = mirror.serve({"greeter", "level", ">d:", {}});
    REQUIRE(level.status == CallStatus::ok);
    wire::CdrReader value(level.bytes);
    CHECK(value.get<double>() == 0.25);
    CHECK(value.remaining() == 0);
    const auto missing = mirror.serve({"greeter", "halt", ":", {}});
    CHECK(missing.status == CallStatus::no_such_operation);
    CHECK_THAT(missing.text(), !Catch::Contains("has its types"));
}

TEST_CASE("a port whose methods have other names is refused with names that fit") {
    Printer printer;
    PrinterProvided provided(printer);
    adaptor::MirrorRequiredPort mirror(
        {link::PortKind::service_required, "greeter", "Greeter", "", "", {{"say", "s:s"}, {"halt", ":"}}});
    CHECK_THAT(mirror.bindProvided(&provided),
               Catch::Contains("operation 'say': the connected port has no such method; echo, print have its "
                               "types: set AdaptorComp's property 'names.greeter' to METHOD=say if one of "
                               "them is meant") &&
                   Catch::Contains("operation 'halt': the connected port has no such method"));
    CHECK_THROWS_WITH(adaptor::PeerNames("names.greeter", "print"),
                      "property 'names.greeter': 'print' is not valid: expected OPROS_NAME=RTC_NAME");
}
