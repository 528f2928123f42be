// SPDX-License-Identifier: Apache-2.0
// The property `strict` of AdaptorComp.
#include "scene.hpp"
#include "tests/support/captured_log.hpp"

#include <InputDataPort.h>
#include <InputEventPort.h>
#include <OutputEventPort.h>
#include <ProvidedMethod.h>
#include <ProvidedServicePort.h>
#include <RequiredMethod.h>
#include <RequiredServicePort.h>

#include <map>

using namespace tandem;
using adaptor::test::Peer;
using tandem::test::CapturedLog;
using Properties = std::map<std::string, std::string>;

namespace {

struct Adaptor {
    Adaptor(const std::string& what, const Properties& properties)
        : name(fmt::format("test-strict-{}-{}", what, getpid())), peer(name) {
        component.setId("Adaptor");
        component.setProperty("link", name);
        for (const auto& [property, value] : properties) component.setProperty(property, value);
    }
    ~Adaptor() { component.destroy(); }
    template <class P>
    P& port(const std::string& of) {
        return dynamic_cast<P&>(*component.getPort(of));
    }

    std::string name;
    Peer peer;
    adaptor::AdaptorComp component;
};

/// A service with a method that the peer's services do not have.
struct Dancer {
    int dance() { return 1; }
};
struct DancerProvided : ProvidedServicePort {
    explicit DancerProvided(Dancer& dancer) {
        addMethod("dance", makeProvidedMethod(&Dancer::dance, &dancer, "dance"));
    }
};
struct DancerRequired : RequiredServicePort {
    DancerRequired() { addMethod("dance", makeRequiredMethod(&DancerRequired::dance, "dance")); }
    int dance() { return (*reinterpret_cast<RequiredMethod<int>*>(getMethod("dance")))(); }
};

/// Tries a connection that the mirror refuses, as a host does.
void connect_wrongly(Adaptor& adaptor, const std::string& kind) {
    if (kind == "data to the peer") {
        opros_any sample{std::string()};
        CHECK_FALSE(adaptor.port<InputDataPortInterface>("position").checkType(sample));
    } else if (kind == "data from the peer") {
        InputDataPort<int> input;
        CHECK_FALSE(adaptor.port<OutputDataPortInterface>("reference").checkType(&input));
    } else if (kind == "events to the peer") {
        OutputEventPort<std::string> output;
        CHECK_FALSE(
            adaptor.port<InputEventPortInterface>("position").checkType(static_cast<EventPort*>(&output)));
    } else if (kind == "events from the peer") {
        InputEventPort<std::string> input;
        CHECK_FALSE(
            adaptor.port<OutputEventPortInterface>("reference").checkType(static_cast<EventPort*>(&input)));
    } else if (kind == "calls to the peer") {
        DancerRequired required;
        CHECK(adaptor.port<ProvidedServicePort>("joystick").bindMethod(required.getMethod("dance")) != "");
    } else {
        Dancer dancer;
        DancerProvided provided(dancer);
        CHECK(adaptor.port<RequiredServicePort>("chair").bindProvided(&provided) != "");
    }
}

std::string port_of(const std::string& kind) {
    if (kind == "calls to the peer") return "joystick";
    if (kind == "calls from the peer") return "chair";
    return kind.ends_with("to the peer") ? "position" : "reference";
}

} // namespace

TEST_CASE("with strict, a property without effect prevents the initialization, and one line names it") {
    const auto [property, value] =
        GENERATE(std::pair<std::string, std::string>{"wiat", "1"}, std::pair{"deadline_ms.position", "1"},
                 std::pair{"wait_ms.postion", "1"}, std::pair{"names.chiar", "a=b"},
                 std::pair{"event_ports", "joystick"}, std::pair{"share", "Nobody"});
    const bool strict = GENERATE(true, false);
    const CapturedLog log;
    Adaptor adaptor("property", {{property, value}, {"strict", strict ? "1" : "0"}});
    INFO(property);
    CHECK((adaptor.component.initialize() == OPROS_SUCCESS) == !strict);
    CHECK(log.lines_with("Adaptor: property '" + property + "'") == 1);
}

TEST_CASE("with strict, each refused connection prevents the start, and one line says why") {
    const std::string kind = GENERATE("data to the peer", "data from the peer", "events to the peer",
                                      "events from the peer", "calls to the peer", "calls from the peer");
    const bool strict = GENERATE(true, false);
    const bool events = kind.starts_with("events");
    const CapturedLog log;
    Adaptor adaptor("connection",
                    {{"event_ports", events ? "position, reference" : ""}, {"strict", strict ? "1" : "0"}});
    INFO(kind);
    REQUIRE(adaptor.component.initialize() == OPROS_SUCCESS);
    connect_wrongly(adaptor, kind);
    CHECK((adaptor.component.start() == OPROS_SUCCESS) == !strict);
    CHECK(log.lines_with("Adaptor: strict: ") == (strict ? 1 : 0));
    CHECK(log.lines_with("port '" + port_of(kind) + "'") == (strict ? 1 : 0));
    CHECK(adaptor.peer.has_received(".activate") == !strict);
}
