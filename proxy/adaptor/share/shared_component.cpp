// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/share/shared_component.hpp"

#include "proxy/adaptor/archive/type_check.hpp"
#include "proxy/adaptor/service/method_types.hpp"

#include <InputDataPortInterface.h>
#include <OutputDataPortInterface.h>
#include <ProvidedServicePort.h>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace tandem::adaptor {
namespace control = link::control;
using control::ComponentState;
using link::PortKind;

namespace {

/// A component that its host destroys at its end may come back with the next host: its RTC waits, in ERROR.
ComponentState shown_state(LifecycleState state, bool exited) {
    switch (state) {
    case OPROS_CS_ACTIVE:
        return ComponentState::active;
    case OPROS_CS_ERROR:
        return ComponentState::error;
    case OPROS_CS_DESTROYED:
        return exited ? ComponentState::destroyed : ComponentState::error;
    default:
        return ComponentState::inactive; // CREATED, READY and INACTIVE: it does not run
    }
}

/// Whether the engine has set the property for itself.
bool is_internal(const std::string& property) { return property.starts_with("_opros_"); }

} // namespace

/// From an output port of the component to a channel of the link.
class SharedComponent::OutConnection final : public IDataPortLink {
  public:
    OutConnection(OutputDataPortInterface& source, const link::Port& port, link::ChannelWriter& channel)
        : source_(source), mirror_(port, channel) {
        opros_any sample = source.sample();
        mirror_.checkType(sample); // the table was made from the same type: this only tells the mirror of it
        source_.addConnection(this);
    }
    ~OutConnection() override { source_.removeConnection(this); }
    OutConnection(const OutConnection&) = delete;
    OutConnection& operator=(const OutConnection&) = delete;

    /// Without a peer, or room, the message is dropped and the component does not see it: its other receivers count.
    ReturnType push(opros_any& data) override {
        const ReturnType result = mirror_.push(data);
        return result == OPROS_OUT_OF_RESOURCES ? OPROS_SUCCESS : result;
    }
    ReturnType setSource(DataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType addDestination(DataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType addDestination(RemoteDataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType removeDestination(DataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType removeDestination(RemoteDataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType clearDestination() override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType clearSource() override { return OPROS_UNSUPPORTED_METHOD; }

  private:
    OutputDataPortInterface& source_;
    MirrorInPort mirror_;
};

SharedComponent::SharedComponent(std::string name, ComponentDirectory& directory)
    : name_(std::move(name)), directory_(directory), component_(*directory.find(name_)) {}

SharedComponent::~SharedComponent() { disconnect(); }

std::vector<std::string>
SharedComponent::describe(link::PortTable& table,
                          const std::map<std::string, std::string>& interfaces) const {
    link::SharedComponent entry{name_, directory_.type(name_), {}};
    for (const auto& [name, value] : component_.getPropertyMap())
        if (!is_internal(name)) entry.properties.push_back({name, value});
    table.components.push_back(std::move(entry));

    std::vector<std::string> refused;
    describe_data_ports(table, refused);
    describe_service_ports(table, interfaces, refused);
    return refused;
}

void SharedComponent::describe_data_ports(link::PortTable& table, std::vector<std::string>& refused) const {
    for (const auto& name : component_.getPortNames(OPROS_DATA)) {
        const auto* port = dynamic_cast<DataPort*>(component_.getPort(name));
        if (!port) continue;
        link::Port shared;
        shared.kind =
            dynamic_cast<const InputDataPortInterface*>(port) ? PortKind::data_in : PortKind::data_out;
        shared.name = name_ + "." + name;
        shared.component = name_;
        const opros_any sample = port->sample();
        shared.type = sample.type();
        try {
            if (!sample.serializable()) throw opros::archive::archive_type_exception();
            shared.signature = wire::to_named_signature(type_of(sample, {}));
            table.ports.push_back(std::move(shared));
        } catch (const std::exception& error) { // thrown by the archive, or by the type's own load()
            refused.push_back(
                fmt::format("port '{}' is not shared: OPRoS type {} cannot be serialized ({}); give "
                            "it save() and load()",
                            shared.name, shared.type, error.what()));
        }
    }
}

void SharedComponent::describe_service_ports(link::PortTable& table,
                                             const std::map<std::string, std::string>& interfaces,
                                             std::vector<std::string>& refused) const {
    for (const auto& name : component_.getPortNames(OPROS_SERVICE)) {
        link::Port shared;
        shared.kind = PortKind::service_provided;
        shared.name = name_ + "." + name;
        shared.component = name_;
        shared.instance = name;
        const auto interface = interfaces.find(shared.name);
        shared.type = interface == interfaces.end() ? name : interface->second;
        auto* provided = dynamic_cast<ProvidedServicePort*>(component_.getPort(name));
        if (!provided || provided->isDynamic()) {
            refused.push_back(
                fmt::format("port '{}' is not shared: only provided service ports are", shared.name));
            continue;
        }
        for (auto method = provided->getFirst(); method != provided->getEnd(); ++method) try {
                shared.operations.push_back(
                    {method->first, describe_method(*method->second).operation_signature()});
            } catch (const wire::SignatureError&) {
                refused.push_back(
                    fmt::format("method '{}' of port '{}' is not shared: one of its types cannot be "
                                "serialized",
                                method->first, shared.name));
            }
        table.ports.push_back(std::move(shared));
    }
}

void SharedComponent::connect(const link::PortTable& table, link::Link& link,
                              const SetArrivalListener& set_listener, std::function<void()> state_changed) {
    for (const auto& port : table.ports)
        if (port.component == name_) connect_port(port, link, set_listener);
    state_changed_ = std::move(state_changed);
    component_.addLifecycleListener(this);
    connected_ = true;
}

void SharedComponent::connect_port(const link::Port& port, link::Link& link,
                                   const SetArrivalListener& set_listener) {
    Port* own = component_.getPort(port.name.substr(name_.size() + 1));
    if (auto* output = dynamic_cast<OutputDataPortInterface*>(own)) {
        outputs_.push_back(std::make_unique<OutConnection>(*output, port, link.writer(port.name)));
    } else if (auto* input = dynamic_cast<InputDataPortInterface*>(own)) {
        auto mirror = std::make_unique<MirrorOutPort>(
            port, link.reader(port.name),
            [set_listener, name = port.name](DataPortListener* listener) { set_listener(name, listener); });
        if (mirror->checkType(input)) // from here on it is a source of the input port
            inputs_.push_back(std::move(mirror));
        else
            spdlog::error("{}", mirror->typeError());
    } else if (auto* provided = dynamic_cast<ProvidedServicePort*>(own)) {
        auto mirror = std::make_unique<MirrorRequiredPort>(port);
        const std::string error = mirror->bindProvided(provided);
        if (!error.empty()) spdlog::error("{}", error);
        services_.push_back(std::move(mirror));
    }
}

MirrorRequiredPort* SharedComponent::find_service(std::string_view name) const {
    for (const auto& service : services_)
        if (service->port() == name) return service.get();
    return nullptr;
}

void SharedComponent::disconnect() {
    if (!connected_) return;
    connected_ = false;
    component_.removeLifecycleListener(this);
    outputs_.clear();
    inputs_.clear();
    for (const auto& service : services_) service->bindProvided(nullptr); // waits for the calls under way
}

void SharedComponent::stateChanged(LifecycleState) { state_changed_(); }

control::StateReport SharedComponent::report() {
    const std::lock_guard lock(report_mutex_);
    return {name_, shown_state(component_.getStatus(), exited_), ++sequence_};
}

std::string SharedComponent::execute(std::string_view command) {
    if (command == control::activate) {
        // Set before: a peer that goes meanwhile must find it.
        if (component_.getStatus() != OPROS_CS_ACTIVE) started_by_peer_ = true;
        return directory_.transition(name_, TRANSITION_START);
    }
    if (command == control::reset) return directory_.transition(name_, TRANSITION_RECOVER);
    started_by_peer_ = false;
    if (command == control::deactivate) return directory_.transition(name_, TRANSITION_STOP);
    exited_ = true; // before: the change of the state is reported at once
    return directory_.transition(name_, TRANSITION_DESTROY);
}

void SharedComponent::peer_lost() {
    if (!started_by_peer_.exchange(false)) return;
    const std::string error = directory_.transition(name_, TRANSITION_STOP);
    if (!error.empty()) spdlog::error("{}", error);
}

} // namespace tandem::adaptor
