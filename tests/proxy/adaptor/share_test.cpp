// SPDX-License-Identifier: Apache-2.0
// OPRoS components that AdaptorComp shares, against a peer that is only a link.
#include "proxy/adaptor/adaptor_comp.hpp"
#include "proxy/link/protocol/control.hpp"
#include "proxy/wire/cdr.hpp"

#include <catch2/catch.hpp>

#include <InputDataPort.h>
#include <OutputDataPort.h>

#include <fmt/format.h>

#include <thread>
#include <unistd.h>

using namespace tandem;
using namespace std::chrono_literals;
using link::CallStatus;
using link::Reply;
namespace control = link::control;
using control::ComponentState;

namespace {

/// A type without save() and load().
struct Opaque {};
inline std::string typeName(Opaque*) { return "Opaque"; }

/// A component that the test controls, and whose ports some RTM type may have.
class Motor : public Component {
  public:
    explicit Motor(const std::string& name) : Component(name) {
        addPort("speed", &speed);
        addPort("torque", &torque);
        addPort("opaque", &opaque);
        setProperty("gain", "2");
        setProperty("_opros_xx_internal_xx_Component_Path", "/somewhere");
    }
    InputDataPort<double> speed;
    OutputDataPort<double> torque;
    OutputDataPort<Opaque> opaque;

  protected:
    ReturnType onInitialize() override { return OPROS_SUCCESS; }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onReset() override { return OPROS_SUCCESS; }
    ReturnType onError() override { return OPROS_SUCCESS; }
    ReturnType onRecover() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }
};

/// The directory of an engine that makes each transition at once.
class Directory : public ComponentDirectory {
  public:
    explicit Directory(std::vector<Motor*> components) : components_(std::move(components)) {}
    std::vector<std::string> names() const override {
        std::vector<std::string> names;
        for (auto* component : components_) names.push_back(component->getId());
        return names;
    }
    Component* find(const std::string& name) override {
        for (auto* component : components_)
            if (component->getId() == name) return component;
        return nullptr;
    }
    std::string type(const std::string&) const override { return "MotorComp"; }
    std::string transition(const std::string& name, ComponentTransition transition) override {
        Component& component = *find(name);
        ReturnType result = OPROS_SUCCESS;
        if (transition == TRANSITION_START) result = component.start();
        if (transition == TRANSITION_STOP) result = component.stop();
        if (transition == TRANSITION_RECOVER) result = component.recover();
        if (transition == TRANSITION_DESTROY) result = component.destroy();
        return result == OPROS_SUCCESS ? "" : "component " + name + " refuses";
    }
    bool setProperty(const std::string& component, const std::string& name,
                     const std::string& value) override {
        find(component)->setProperty(name, value);
        return true;
    }
    bool isEnding() const override { return false; }
    bool isConnected(const std::string&, const std::string&) const override { return false; }
    std::string connect(const std::string&, Port& port, const std::string& component,
                        const std::string& component_port) override {
        auto* required = dynamic_cast<RequiredServicePort*>(&port);
        auto* provided = dynamic_cast<ProvidedServicePort*>(find(component)->getPort(component_port));
        if (!required || !provided) return "this engine connects nothing";
        return required->bindProvided(provided);
    }
    void disconnect(Port& port) override {
        if (auto* required = dynamic_cast<RequiredServicePort*>(&port)) required->bindProvided(nullptr);
    }

  private:
    std::vector<Motor*> components_;
};

/// The RTM side: keeps the peer's table and the newest state of each component.
struct RtmSide : link::LinkHandler {
    explicit RtmSide(const std::string& name) : link(shm::Side::second, {name}, {}, *this) { link.open(); }
    ~RtmSide() override { link.close(); }
    std::string check_peer_ports(link::PortTable& peer) override {
        const std::lock_guard lock(mutex);
        table = peer;
        return "";
    }
    void link_state_changed(bool) override {}
    void deadline_missed(const std::string&) override {}
    void peer_connected() override {}
    void peer_disconnected() override {}
    Reply serve(const link::Request& request) override {
        if (request.operation != control::state) return {};
        const auto report = control::decode_state_report(request.arguments);
        const std::lock_guard lock(mutex);
        auto& newest = states[report.component];
        if (report.sequence > newest.sequence) newest = report;
        return {};
    }
    /// Returns whether that state is soon the last one reported.
    bool sees(const std::string& component, ComponentState state) {
        const auto deadline = std::chrono::steady_clock::now() + 10s;
        while (std::chrono::steady_clock::now() < deadline) {
            {
                const std::lock_guard lock(mutex);
                if (states.count(component) != 0 && states[component].state == state) return true;
            }
            std::this_thread::sleep_for(1ms);
        }
        return false;
    }
    Reply ask(std::string_view command, const std::string& component) {
        return link.call({"", command, "", control::encode_string(component)}, 10s);
    }

    std::mutex mutex;
    link::PortTable table;
    std::map<std::string, control::StateReport> states;
    link::Link link;
};

struct ShareScene {
    explicit ShareScene(const std::string& what)
        : name(fmt::format("test-share-{}-{}", what, getpid())), rtm(std::make_unique<RtmSide>(name)) {
        for (auto* component : {&motor, &pump}) REQUIRE(component->initialize() == OPROS_SUCCESS);
        adaptor.setId("Adaptor");
        adaptor.setProperty("link", name);
        adaptor.setProperty("share", "Motor, Pump");
        adaptor.setComponentDirectory(&directory);
        REQUIRE(adaptor.initialize() == OPROS_SUCCESS);
        rtm->link.wait_until_up(10s, "adaptor");
    }
    ~ShareScene() { adaptor.destroy(); }

    std::string name;
    Motor motor{"Motor"}, pump{"Pump"};
    Directory directory{{&motor, &pump}};
    std::unique_ptr<RtmSide> rtm;
    adaptor::AdaptorComp adaptor;
};

} // namespace

TEST_CASE("the table has shared components with those ports and properties that can cross") {
    ShareScene scene("table");
    const auto& table = scene.rtm->table;
    CHECK(table.model == "OPRoS");
    REQUIRE(table.components.size() == 2);
    CHECK(table.components[0] == link::SharedComponent{"Motor", "MotorComp", {{"gain", "2"}}});
    REQUIRE(table.ports.size() == 4);
    const auto* torque = table.find("Pump.torque");
    REQUIRE(torque);
    CHECK((torque->kind == link::PortKind::data_out && torque->signature == "d" &&
           torque->component == "Pump"));
    CHECK(table.find("Motor.speed")->kind == link::PortKind::data_in);
    CHECK(table.find("Motor.opaque") == nullptr);
}

TEST_CASE("each change of the state of a shared component is reported, whoever causes it") {
    ShareScene scene("states");
    auto& rtm = *scene.rtm;
    auto& motor = scene.motor;
    CHECK(rtm.sees("Motor", ComponentState::inactive));
    CHECK(rtm.sees("Pump", ComponentState::inactive));
    const auto step = [&](ReturnType result, ComponentState expected) {
        CHECK(result == OPROS_SUCCESS);
        CHECK(rtm.sees("Motor", expected));
    };
    step(motor.start(), ComponentState::active);
    step(motor.stop(), ComponentState::inactive);
    step(motor.start(), ComponentState::active);
    step(motor.stopOnError(), ComponentState::error);
    step(motor.recover(), ComponentState::inactive);
    step(motor.start(), ComponentState::active);
    step(motor.stopOnError(), ComponentState::error);
    step(motor.reset(), ComponentState::active);
    step(motor.fail(), ComponentState::error);
    step(motor.destroy(), ComponentState::error); // its host ends; it may come back with the next one
    CHECK(rtm.sees("Pump", ComponentState::inactive));
}

TEST_CASE("the peer's commands are transitions of one shared component, and the reply is its state") {
    ShareScene scene("commands");
    auto& rtm = *scene.rtm;
    const auto state_after = [&](std::string_view command, const std::string& component) {
        const auto reply = rtm.ask(command, component);
        REQUIRE(reply.status == CallStatus::ok);
        return control::decode_state_report(reply.bytes).state;
    };
    CHECK(state_after(control::activate, "Motor") == ComponentState::active);
    CHECK(scene.motor.getStatus() == OPROS_CS_ACTIVE);
    CHECK(scene.pump.getStatus() == OPROS_CS_READY);
    CHECK(state_after(control::deactivate, "Motor") == ComponentState::inactive);
    scene.pump.start();
    scene.pump.stopOnError();
    CHECK(rtm.ask(control::activate, "Pump").text() == "component Pump refuses");
    CHECK(state_after(control::reset, "Pump") == ComponentState::inactive);
    CHECK(state_after(control::exit, "Pump") == ComponentState::destroyed);
    CHECK(rtm.ask(control::activate, "Nobody").text() == "no component 'Nobody' is shared");
    CHECK(rtm.ask("dance", "Motor").status == CallStatus::no_such_operation);
    CHECK(rtm.link.call({"", control::configure, "", {}}, 10s).status == CallStatus::bad_arguments);
    const auto setting = control::encode(control::Setting{"Motor", "gain", "3"});
    CHECK(rtm.link.call({"", control::configure, "", setting}, 10s).status == CallStatus::ok);
    CHECK(scene.motor.getProperty("gain") == "3");
}

TEST_CASE("a property that a shared component does not have is refused") {
    ShareScene scene("unknown");
    const auto set = [&](const std::string& component, const std::string& name) {
        const auto setting = control::encode(control::Setting{component, name, "3"});
        return scene.rtm->link.call({"", control::configure, "", setting}, 10s);
    };
    const auto reply = set("Motor", "gian");
    CHECK(reply.status == CallStatus::bad_arguments);
    CHECK(reply.text() == "component Motor has no property gian (it has: gain)");
    CHECK(set("Motor", "_opros_xx_internal_xx_Component_Path").status == CallStatus::bad_arguments);
    CHECK(scene.motor.getPropertyMap().count("gian") == 0);
    CHECK(set("Nobody", "gain").text() == "no component 'Nobody' is shared");
}

TEST_CASE("values cross to and from the ports of a shared component") {
    ShareScene scene("data");
    auto& rtm = *scene.rtm;
    std::uint64_t stamp = 7;
    REQUIRE(rtm.link.writer("Motor.speed").write(stamp, [](wire::CdrWriter& out) { out.put(1.5); }));
    const std::unique_ptr<opros_any> speed(scene.motor.speed.pop());
    REQUIRE(speed);
    CHECK(scene.motor.speed.getContent(*speed) == 1.5);
    scene.motor.torque.push(2.5);
    double torque = 0;
    CHECK(rtm.link.reader("Motor.torque").read(false, [&](const shm::Record& record) {
        torque = wire::CdrReader(record.bytes).get<double>();
    }));
    CHECK(torque == 2.5);
}

TEST_CASE("without a peer a shared component sends as before, and stops if the peer has started it") {
    ShareScene scene("alone");
    REQUIRE(scene.rtm->ask(control::activate, "Motor").status == CallStatus::ok);
    scene.pump.start();
    scene.rtm.reset();
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    while (scene.motor.getStatus() != OPROS_CS_INACTIVE && std::chrono::steady_clock::now() < deadline)
        std::this_thread::sleep_for(1ms);
    CHECK(scene.motor.getStatus() == OPROS_CS_INACTIVE);
    CHECK(scene.pump.getStatus() == OPROS_CS_ACTIVE);
    CHECK(scene.pump.torque.push(1.0) == OPROS_SUCCESS);
}
