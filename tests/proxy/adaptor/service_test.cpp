// SPDX-License-Identifier: Apache-2.0
// The mirrors of service ports against a link whose other side is only a table and a function.
#include "provided_port_connector.hpp"
#include "proxy/adaptor/service/mirror_provided_port.hpp"
#include "proxy/adaptor/service/mirror_required_port.hpp"
#include "proxy/link/protocol/service_exception.hpp"
#include "tests/proxy/link/link_side.hpp"

#include <catch2/catch.hpp>

#include <MethodInvokeException.h>
#include <ProvidedMethod.h>
#include <RequiredMethod.h>

using namespace tandem;
using namespace std::chrono_literals;
using link::CallStatus;
using link::Reply;
using link::test::eventually;
using link::test::soon;

namespace {

const link::Port arm_port{link::PortKind::service_provided,
                          "arm",
                          "Arm",
                          "",
                          "arm",
                          {{"move", "d>d&ai:b raises IDL:Arm/Blocked:1.0({joint}i{place}(dd))"},
                           {"measure", "i>d>s:i"},
                           {"stop", ": oneway"},
                           {"_get_speed", ":d"},
                           {"_set_speed", "d:"},
                           {"grasp", "{how}({deep}?{an Arm::How}):i"},
                           {"wave", "d:"},
                           {"take", "{tool}<i;0,1={grip}d;*={name}s>>{old}<i;0,1={grip}d;*={name}s>:i"}}};

struct Place {
    double x = 0, y = 0;
    bool operator==(const Place&) const = default;
};
inline std::string typeName(Place*) { return "Place"; }
inline void save_this(opros::archive::oarchive& ar, Place& place) { ar << place.x << place.y; }
inline void load_this(opros::archive::iarchive& ar, Place& place) { ar >> place.x >> place.y; }

/// The results of `measure` in one value.
struct Measured {
    int code = 0;
    double value = 0;
    std::string unit;
};
inline std::string typeName(Measured*) { return "Measured"; }
inline void save_this(opros::archive::oarchive& ar, Measured& m) { ar << m.code << m.value << m.unit; }
inline void load_this(opros::archive::iarchive& ar, Measured& m) { ar >> m.code >> m.value >> m.unit; }

/// A union of IDL: a number for the kinds 0 and 1, a text for all others.
struct Tool {
    int kind = 0;
    double grip = 0;
    std::string name;
};
inline std::string typeName(Tool*) { return "Tool"; }
inline void save_this(opros::archive::oarchive& ar, Tool& tool) {
    ar << tool.kind;
    tool.kind == 0 || tool.kind == 1 ? ar << tool.grip : ar << tool.name;
}
inline void load_this(opros::archive::iarchive& ar, Tool& tool) {
    ar >> tool.kind;
    tool.kind == 0 || tool.kind == 1 ? ar >> tool.grip : ar >> tool.name;
}

class ArmRequired : public RequiredServicePort {
  public:
    ArmRequired() {
        addMethod("move", makeRequiredMethod(&ArmRequired::move, "move"));
        addMethod("measure", makeRequiredMethod(&ArmRequired::measure, "measure"));
        addMethod("stop", makeRequiredMethod(&ArmRequired::stop, "stop"));
        addMethod("getSpeed", makeRequiredMethod(&ArmRequired::getSpeed, "getSpeed"));
        addMethod("set_speed", makeRequiredMethod(&ArmRequired::set_speed, "set_speed"));
        addMethod("grasp", makeRequiredMethod(&ArmRequired::grasp, "grasp"));
        addMethod("wave", makeRequiredMethod(&ArmRequired::wave, "wave"));
        addMethod("take", makeRequiredMethod(&ArmRequired::take, "take"));
    }
    int take(Tool tool, Tool& old) { return as<int>("take")(tool, old); }
    bool move(double to, double& reached, std::vector<int>* touched) {
        return as<bool>("move")(to, reached, touched);
    }
    Measured measure(int axis) { return as<Measured>("measure")(axis); }
    void stop() { as<void>("stop")(); }
    double getSpeed() { return as<double>("getSpeed")(); }
    void set_speed(double speed) { as<void>("set_speed")(speed); }
    int grasp(int how) { return as<int>("grasp")(how); }
    void wave(int times) { as<void>("wave")(times); }

  private:
    template <class R>
    RequiredMethod<R>& as(const char* name) {
        return *reinterpret_cast<RequiredMethod<R>*>(getMethod(name));
    }
};

struct Arm {
    bool move(double to, double& reached, std::vector<int>* touched) {
        reached = to / 2;
        touched->push_back(static_cast<int>(to));
        if (to > 90) throw MethodInvokeException("blocked", "IDL:Arm/Blocked:1.0", 3, Place{1, 2});
        if (to > 80) throw MethodInvokeException("blocked", "IDL:Arm/Blocked:1.0", 3.5);
        return to > 0;
    }
    Measured measure(int axis) { return {axis, axis * 1.5, "mm"}; }
    double getSpeed() { return speed; }
    void set_speed(double value) { speed = value; }
    void wave(int) {}
    int take(Tool tool, Tool& old) {
        old = std::exchange(held, tool);
        return tool.kind;
    }
    double speed = 7;
    Tool held{0, 1.5, ""};
};

struct ArmProvided : ProvidedServicePort {
    explicit ArmProvided(Arm& arm) {
        addMethod("move", makeProvidedMethod(&Arm::move, &arm, "move"));
        addMethod("measure", makeProvidedMethod(&Arm::measure, &arm, "measure"));
        addMethod("getSpeed", makeProvidedMethod(&Arm::getSpeed, &arm, "getSpeed"));
        addMethod("set_speed", makeProvidedMethod(&Arm::set_speed, &arm, "set_speed"));
        addMethod("wave", makeProvidedMethod(&Arm::wave, &arm, "wave"));
        addMethod("take", makeProvidedMethod(&Arm::take, &arm, "take"));
    }
};

/// An OPRoS component's required port, connected to the mirror of a port that the other side of a link provides.
struct ServiceScene {
    explicit ServiceScene(const std::string& what)
        : name(link::test::unique_name("service-" + what)), here(link::test::adaptor(name)),
          peer(link::test::interceptor(name)), mirror(arm_port, here->link, 5s), connector(mirror) {
        here->link.open();
        peer->link.open();
        here->link.wait_until_up(soon, "peer");
        for (auto at = required.getFirst(); at != required.getEnd(); ++at) {
            const std::string refusal = mirror.bindMethod(at->second);
            if (!refusal.empty()) refusals[at->first] = refusal;
            static_cast<RequiredMethodInterface&>(*at->second).Connect(&connector);
        }
    }
    std::string name;
    std::unique_ptr<link::test::LinkSide> here, peer;
    adaptor::MirrorProvidedPort mirror;
    ProvidedPortConnector connector;
    ArmRequired required;
    std::map<std::string, std::string> refusals;
};

template <class F>
MethodInvokeException thrown_by(F call) {
    try {
        call();
    } catch (const MethodInvokeException& error) {
        return error;
    }
    FAIL("no exception");
    throw;
}

template <class... Values>
std::vector<std::byte> encoded(const Values&... values) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    (out.put(values), ...);
    return bytes;
}

} // namespace

TEST_CASE("operations that cannot cross or do not fit affect no others and report the reason when called") {
    ServiceScene scene("some");
    scene.peer->on_call = [](const link::Request&) { return Reply{CallStatus::ok, encoded(2.5)}; };
    CHECK(scene.refusals.size() == 2);
    CHECK_THAT(scene.refusals["grasp"], Catch::Contains("'arm'") && Catch::Contains("Arm::How"));
    CHECK_THAT(scene.refusals["wave"], Catch::Contains("'i:'") && Catch::Contains("'d:'") &&
                                           Catch::Contains("argument 1 is int32 here, double there"));
    CHECK(scene.required.getSpeed() == 2.5);
    const auto error = thrown_by([&] { scene.required.grasp(1); });
    CHECK(error.what() == scene.refusals["grasp"]);
    CHECK(error.getId() == "IDL:omg.org/CORBA/BAD_OPERATION:1.0");
}

TEST_CASE("out and inout arguments return with new values, and an out argument is not sent") {
    ServiceScene scene("out");
    scene.connector.copies = GENERATE(false, true);
    scene.peer->on_call = [](const link::Request& request) {
        CHECK(request.signature == "d>d&ai:b");
        wire::CdrReader in(request.arguments);
        const double to = in.get<double>();
        CHECK(in.get_count(4) == 1);
        CHECK(in.get<std::int32_t>() == 8);
        CHECK(in.remaining() == 0);
        Reply reply;
        wire::CdrWriter out(reply.bytes);
        out.put_bool(true);
        out.put(to / 4);
        out.put<std::uint32_t>(2);
        out.put<std::int32_t>(9);
        out.put<std::int32_t>(10);
        return reply;
    };
    double reached = -1;
    std::vector<int> touched{8};
    CHECK(scene.required.move(6, reached, &touched));
    CHECK(reached == 1.5);
    CHECK(touched == std::vector<int>{9, 10});
}

TEST_CASE("a union is an argument, and each of its cases comes back") {
    constexpr const char* signature = "<i;0,1=d;*=s>><i;0,1=d;*=s>:i";
    ServiceScene scene("union");
    scene.peer->on_call = [&](const link::Request& request) {
        CHECK(request.signature == signature);
        wire::CdrReader in(request.arguments);
        CHECK(in.get<std::int32_t>() == 1);
        CHECK(in.get<double>() == 0.5);
        CHECK(in.remaining() == 0);
        Reply reply;
        wire::CdrWriter out(reply.bytes);
        out.put<std::int32_t>(4);
        out.put<std::int32_t>(9);
        out.put_string("drill");
        return reply;
    };
    Tool old;
    CHECK(scene.required.take({1, 0.5, ""}, old) == 4);
    CHECK((old.kind == 9 && old.name == "drill"));

    adaptor::MirrorRequiredPort mirror(arm_port);
    Arm arm;
    ArmProvided provided(arm);
    REQUIRE(mirror.bindProvided(&provided) == "");
    std::vector<std::byte> arguments;
    wire::CdrWriter out(arguments);
    out.put<std::int32_t>(9);
    out.put_string("drill");
    const auto reply = mirror.serve({"arm", "take", signature, arguments});
    REQUIRE(reply.status == CallStatus::ok);
    wire::CdrReader in(reply.bytes);
    CHECK(in.get<std::int32_t>() == 9);
    CHECK(in.get<std::int32_t>() == 0);
    CHECK(in.get<double>() == 1.5);
    CHECK((in.ok() && in.remaining() == 0));
    CHECK(arm.held.name == "drill");
}

TEST_CASE("a method without references gets result and out arguments as one structure") {
    ServiceScene scene("structure");
    scene.peer->on_call = [](const link::Request&) {
        Reply reply;
        wire::CdrWriter out(reply.bytes);
        out.put<std::int32_t>(4);
        out.put(0.5);
        out.put_string("mm");
        return reply;
    };
    const auto measured = scene.required.measure(1);
    CHECK((measured.code == 4 && measured.value == 0.5 && measured.unit == "mm"));
}

TEST_CASE("a user exception arrives with its id and its fields") {
    ServiceScene scene("exception");
    scene.peer->on_call = [](const link::Request&) {
        return link::make_exception_reply({"IDL:Arm/Blocked:1.0", "operation 'move': IDL:Arm/Blocked:1.0",
                                           encoded(std::int32_t{5}, 0.25, 0.75)});
    };
    double reached = 0;
    std::vector<int> touched;
    const auto error = thrown_by([&] { scene.required.move(1, reached, &touched); });
    CHECK(error.getId() == "IDL:Arm/Blocked:1.0");
    CHECK_THAT(error.what(), Catch::Contains("'arm.move'") && Catch::Contains("Blocked"));
    int joint = 0;
    Place place;
    REQUIRE(error.getFields(joint, place));
    CHECK((joint == 5 && place == Place{0.25, 0.75}));
    CHECK_FALSE(error.getFields(joint));
    CHECK_FALSE(error.getFields(place, joint));
    scene.peer->on_call = [](const link::Request&) {
        return link::make_exception_reply({"IDL:Arm/Blocked:1.0", "short", encoded(std::int32_t{5})});
    };
    CHECK_FALSE(thrown_by([&] { scene.required.move(1, reached, &touched); }).getFields(joint, place));
}

TEST_CASE("a call that fails on the way has the id of a CORBA system exception") {
    ServiceScene scene("system");
    const auto id_of = [&](CallStatus status, const char* text) {
        scene.peer->on_call = [=](const link::Request&) { return Reply::failure(status, text); };
        return thrown_by([&] { scene.required.getSpeed(); }).getId();
    };
    CHECK(id_of(CallStatus::timeout, "late") == "IDL:omg.org/CORBA/TIMEOUT:1.0");
    scene.peer->on_call = [](const link::Request&) { return Reply::failure(CallStatus::timeout, ""); };
    CHECK_THAT(thrown_by([&] { scene.required.getSpeed(); }).what(),
               Catch::Contains("no reply within ") &&
                   Catch::Contains("AdaptorComp's property 'call_timeout' allows more"));
    CHECK(id_of(CallStatus::not_ready, "not ready: x") == "IDL:omg.org/CORBA/TRANSIENT:1.0");
    CHECK(id_of(CallStatus::exception, "broken") == "IDL:omg.org/CORBA/UNKNOWN:1.0");
    CHECK(id_of(CallStatus::bad_arguments, "odd") == "IDL:omg.org/CORBA/BAD_PARAM:1.0");
    scene.peer->link.close();
    REQUIRE(eventually([&] { return !scene.here->link.is_up(); }));
    const auto error = thrown_by([&] { scene.required.getSpeed(); });
    CHECK(error.getId() == "IDL:omg.org/CORBA/TRANSIENT:1.0");
    CHECK_THAT(error.what(), Catch::Contains("not ready: "));
}

TEST_CASE("a oneway operation is called without waiting and an attribute by its method") {
    ServiceScene scene("oneway");
    std::atomic<bool> release{false};
    std::atomic<int> stops{0};
    scene.peer->on_call = [&](const link::Request& request) {
        if (request.operation == "stop") {
            eventually([&] { return release.load(); });
            ++stops;
        }
        if (request.operation == "_set_speed") CHECK(wire::CdrReader(request.arguments).get<double>() == 3);
        return request.operation == "_get_speed" ? Reply{CallStatus::ok, encoded(3.0)} : Reply{};
    };
    scene.required.stop(); // would wait for ever
    scene.required.set_speed(3);
    CHECK(scene.required.getSpeed() == 3);
    CHECK(stops == 0);
    release = true;
    CHECK(eventually([&] { return stops == 1; }));
}

TEST_CASE("the peer calls methods with out arguments, attributes and results of several values") {
    adaptor::MirrorRequiredPort mirror(arm_port);
    CHECK(mirror.serve({"arm", "move", "d>d&ai:b", {}}).status == CallStatus::not_ready);
    Arm arm;
    ArmProvided provided(arm);
    REQUIRE(mirror.bindProvided(&provided) == "");
    std::string names;
    for (const auto& operation : mirror.operations()) names += operation.name + " ";
    CHECK(names == "_get_speed _set_speed measure move take ");

    std::vector<std::byte> arguments;
    wire::CdrWriter out(arguments);
    out.put(5.0);
    out.put<std::uint32_t>(0);
    const auto moved = mirror.serve({"arm", "move", "d>d&ai:b", arguments});
    REQUIRE(moved.status == CallStatus::ok);
    wire::CdrReader in(moved.bytes);
    CHECK(in.get_bool());
    CHECK(in.get<double>() == 2.5);
    CHECK(in.get_count(4) == 1);
    CHECK(in.get<std::int32_t>() == 5);
    CHECK((in.ok() && in.remaining() == 0));

    const auto measured = mirror.serve({"arm", "measure", "i>d>s:i", encoded(std::int32_t{2})});
    REQUIRE(measured.status == CallStatus::ok);
    wire::CdrReader back(measured.bytes);
    CHECK(back.get<std::int32_t>() == 2);
    CHECK(back.get<double>() == 3);
    CHECK(back.get_string() == "mm");

    CHECK(mirror.serve({"arm", "_set_speed", "d:", encoded(8.0)}).status == CallStatus::ok);

    // Makes the same call by ids. A caller with other types does not have these ids.
    const auto by_ids = [&](const char* operation, const char* signature,
                            const std::vector<std::byte>& sent) {
        wire::MessageBuffer memory;
        const auto reply = mirror.serve_known(
            {{link::port_id("arm"), link::operation_id(operation, signature)}, sent}, memory);
        return reply ? std::optional(reply->copy()) : std::nullopt;
    };
    const auto known = by_ids("measure", "i>d>s:i", encoded(std::int32_t{2}));
    REQUIRE(known);
    CHECK(known->bytes == measured.bytes);
    CHECK_FALSE(by_ids("measure", "d>d>s:i", encoded(2.0)));
    CHECK_FALSE(by_ids("wave", "i:", {}));
    CHECK(by_ids("measure", "i>d>s:i", {})->status == CallStatus::bad_arguments);
    mirror.bindProvided(nullptr);
    CHECK_FALSE(by_ids("measure", "i>d>s:i", encoded(std::int32_t{2})));
    REQUIRE(mirror.bindProvided(&provided) == "");
    CHECK(arm.speed == 8);
    for (const char* missing : {"stop", "grasp", "wave"}) {
        const auto reply = mirror.serve({"arm", missing, ":", {}});
        CHECK(reply.status == CallStatus::no_such_operation);
        CHECK_FALSE(reply.text().empty());
    }
}

TEST_CASE(
    "an exception of an OPRoS method that the IDL declares is sent with its fields and any other as text") {
    adaptor::MirrorRequiredPort mirror(arm_port);
    Arm arm;
    ArmProvided provided(arm);
    REQUIRE(mirror.bindProvided(&provided) == "");
    const auto move = [&](double to) {
        std::vector<std::byte> arguments;
        wire::CdrWriter out(arguments);
        out.put(to);
        out.put<std::uint32_t>(0);
        return mirror.serve({"arm", "move", "d>d&ai:b", arguments});
    };
    const auto declared = move(91);
    REQUIRE(declared.status == CallStatus::user_exception);
    const auto exception = link::decode_service_exception(declared.bytes);
    CHECK(exception.id == "IDL:Arm/Blocked:1.0");
    CHECK(exception.text == "blocked");
    wire::CdrReader fields(exception.fields);
    CHECK(fields.get<std::int32_t>() == 3);
    CHECK(fields.get<double>() == 1);
    CHECK(fields.get<double>() == 2);
    const auto wrong = move(81);
    CHECK(wrong.status == CallStatus::exception);
    CHECK_THAT(wrong.text(), Catch::Contains("blocked") && Catch::Contains("'i(dd)'"));
}

TEST_CASE("a port that provides none of the required operations is refused with the reason") {
    adaptor::MirrorRequiredPort mirror(
        {link::PortKind::service_required, "arm", "Arm", "", "", {{"wave", "d:"}}});
    Arm arm;
    ArmProvided provided(arm);
    CHECK_THAT(mirror.bindProvided(&provided), Catch::Contains("'wave'") && Catch::Contains("'i:'"));
    // The peer's calls get the same reason, and not the reason that no component is connected yet.
    const auto reply = mirror.serve({"arm", "wave", "d:", {}});
    CHECK(reply.status == CallStatus::no_such_operation);
    CHECK_THAT(reply.text(), Catch::Contains("argument 1 is int32 here, double there"));
    mirror.bindProvided(nullptr);
    CHECK(mirror.serve({"arm", "wave", "d:", {}}).status == CallStatus::not_ready);
}
