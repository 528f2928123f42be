// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/share/shared_component.hpp"

#include "proxy/adaptor/share/describe_ports.hpp"

#include <InputDataPortInterface.h>
#include <InputEventPortInterface.h>
#include <ProvidedServicePort.h>

#include <spdlog/spdlog.h>

namespace tandem::adaptor {
namespace control = link::control;
using control::ComponentState;

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

    return describe_ports(name_, directory_, interfaces, table);
}

void SharedComponent::watch(Changes changes) {
    changes_ = std::move(changes);
    component_.addLifecycleListener(this);
    component_.addPortListener(this);
    watched_ = true;
}

void SharedComponent::connect_port(const std::string& owner, const link::Port& port, link::Link& link,
                                   const SetArrivalListener& set_listener,
                                   std::chrono::milliseconds call_timeout) {
    const auto set_port_listener = [set_listener, name = port.name](DataPortListener* listener) {
        set_listener(name, listener);
    };
    const std::string own_name = port.name.substr(name_.size() + 1);
    Port* own = component_.getPort(own_name);
    std::string error;
    if (auto* output = dynamic_cast<OutputDataPortInterface*>(own)) {
        outputs_.push_back(std::make_unique<OutConnection<DataEnds>>(*output, port, link.writer(port.name)));
    } else if (auto* input = dynamic_cast<InputDataPortInterface*>(own)) {
        auto mirror = std::make_unique<MirrorOutPort>(port, link.reader(port.name), set_port_listener);
        if (mirror->checkType(input)) // from here on it is a source of the input port
            inputs_.push_back(std::move(mirror));
        else
            error = mirror->typeError();
    } else if (auto* event_output = dynamic_cast<OutputEventPortInterface*>(own)) {
        event_outputs_.push_back(
            std::make_unique<OutConnection<EventEnds>>(*event_output, port, link.writer(port.name)));
    } else if (dynamic_cast<InputEventPortInterface*>(own) != nullptr) {
        event_inputs_.push_back(
            std::make_unique<MirrorEventOutPort>(port, link.reader(port.name), set_port_listener));
        error = directory_.connect(owner, *event_inputs_.back(), name_, own_name);
    } else if (auto* provided = dynamic_cast<ProvidedServicePort*>(own)) {
        auto mirror = std::make_unique<MirrorRequiredPort>(port);
        error = mirror->bindProvided(provided);
        services_.push_back(std::move(mirror));
        services_by_name_.add(port.name, *services_.back(), link::port_id(port.name));
    } else {
        required_.push_back(std::make_unique<SharedRequiredPort>(port, link, call_timeout));
        required_by_name_.add(port.name, *required_.back(), link::port_id(port.name));
        error = directory_.connect(owner, *required_.back(), name_, own_name);
    }
    if (!error.empty()) spdlog::error("port '{}' is not shared: {}", port.name, error);
}

void SharedComponent::disconnect() {
    if (!watched_) return;
    watched_ = false;
    component_.removeLifecycleListener(this);
    component_.removePortListener(this);
    outputs_.clear();
    inputs_.clear();
    event_outputs_.clear();
    for (const auto& port : event_inputs_) directory_.disconnect(*port);
    for (const auto& port : required_) directory_.disconnect(*port);
    for (const auto& service : services_) service->bindProvided(nullptr); // waits for the calls under way
}

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
