// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/share/shared_component.hpp"

#include "host/log/log.hpp"
#include "proxy/adaptor/names/engine_property.hpp"
#include "proxy/adaptor/share/describe_ports.hpp"

#include <InputDataPortInterface.h>
#include <InputEventPortInterface.h>
#include <ProvidedServicePort.h>

namespace tandem::adaptor {
namespace control = link::control;
using control::ComponentState;

namespace {

/// A component that is destroyed because its host ends may return with the next host. Until then its RTC stays in ERROR.
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

} // namespace

SharedComponent::SharedComponent(std::string name, ComponentDirectory& directory)
    : name_(std::move(name)), directory_(directory), component_(*directory.find(name_)) {
    for (const auto& [property, value] : component_.getPropertyMap())
        if (!is_set_by_engine(property)) properties_[property] = value;
}

SharedComponent::~SharedComponent() { disconnect(); }

std::vector<std::string>
SharedComponent::describe(link::PortTable& table,
                          const std::map<std::string, std::string>& interfaces) const {
    link::SharedComponent entry{name_, directory_.type(name_), {}};
    {
        const std::lock_guard lock(properties_mutex_);
        for (const auto& [name, value] : properties_) entry.properties.push_back({name, value});
    }
    table.components.push_back(std::move(entry));

    return describe_ports(name_, directory_, interfaces, table);
}

std::vector<std::string> SharedComponent::property_names() const {
    const std::lock_guard lock(properties_mutex_);
    std::vector<std::string> names;
    for (const auto& [name, value] : properties_) names.push_back(name);
    return names;
}

void SharedComponent::property_set(const std::string& name, const std::string& value) {
    const std::lock_guard lock(properties_mutex_);
    properties_[name] = value;
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
    const std::string own_name = port.name.substr(name_.size() + 1);
    std::string error;
    {
        const std::lock_guard lock(ports_mutex_);
        Port* own = component_.getPort(own_name);
        auto& connected = ports_[own_name];
        if (connected.own == own && connected.port.is_same(port)) return;
        end(std::move(connected.connection)); // made while the component replaced the port
        connected = {port, own, {}};
        if (own)
            connected.connection = make_connection(owner, port, own, link, set_listener, call_timeout, error);
    }
    if (!error.empty()) log::error("port '{}' is not shared: {}", port.name, error);
}

SharedComponent::Connection SharedComponent::make_connection(const std::string& owner, const link::Port& port,
                                                             Port* own, link::Link& link,
                                                             const SetArrivalListener& set_listener,
                                                             std::chrono::milliseconds call_timeout,
                                                             std::string& error) {
    const auto set_port_listener = [set_listener, port](DataPortListener* listener) {
        set_listener(port, listener);
    };
    const std::string own_name = port.name.substr(name_.size() + 1);
    // Messages that an earlier port of the same type has left in the ring are too old.
    if (port.kind == link::PortKind::data_in) link.reader(port).discard();
    if (auto* output = dynamic_cast<OutputDataPortInterface*>(own))
        return std::make_unique<OutConnection<DataEnds>>(*output, port, link.writer(port));
    if (auto* input = dynamic_cast<InputDataPortInterface*>(own)) {
        auto mirror = std::make_unique<MirrorOutPort>(port, link.reader(port), set_port_listener);
        if (mirror->checkType(input)) return mirror; // from here on it is a source of the input port
        error = mirror->typeError();
        return {};
    }
    if (auto* event_output = dynamic_cast<OutputEventPortInterface*>(own))
        return std::make_unique<OutConnection<EventEnds>>(*event_output, port, link.writer(port));
    if (dynamic_cast<InputEventPortInterface*>(own) != nullptr) {
        auto mirror = std::make_unique<MirrorEventOutPort>(port, link.reader(port), set_port_listener);
        error = directory_.connect(owner, *mirror, name_, own_name);
        return mirror;
    }
    if (dynamic_cast<ProvidedServicePort*>(own) != nullptr) {
        auto mirror = std::make_unique<MirrorRequiredPort>(port);
        error = directory_.connect(owner, *mirror, name_, own_name);
        services_by_name_.add(port.name, *mirror, link::port_id(port.name));
        return mirror;
    }
    auto mirror = std::make_unique<SharedRequiredPort>(port, link, call_timeout);
    required_by_name_.add(port.name, *mirror, link::port_id(port.name));
    error = directory_.connect(owner, *mirror, name_, own_name);
    return mirror;
}

/// Called in the thread that removes the port. When it returns, the component may destroy the port.
void SharedComponent::portRemoved(const std::string& name, Port& port) {
    {
        const std::lock_guard lock(ports_mutex_);
        const auto found = ports_.find(name);
        if (found != ports_.end() && found->second.own == &port) {
            end(std::move(found->second.connection));
            ports_.erase(found);
        }
    }
    changes_.ports();
}

/// With ports_mutex_ held. On return the component's port is not in use.
void SharedComponent::end(Connection connection) {
    if (auto* event_input = std::get_if<std::unique_ptr<MirrorEventOutPort>>(&connection))
        directory_.disconnect(**event_input);
    if (auto* required = std::get_if<std::unique_ptr<SharedRequiredPort>>(&connection)) {
        directory_.disconnect(**required);
        ended_.push_back(std::move(connection));
    } else if (auto* service = std::get_if<std::unique_ptr<MirrorRequiredPort>>(&connection)) {
        directory_.disconnect(**service); // waits for the calls under way
        ended_.push_back(std::move(connection));
    }
}

void SharedComponent::disconnect() {
    if (!watched_) return;
    watched_ = false;
    component_.removeLifecycleListener(this);
    component_.removePortListener(this);
    const std::lock_guard lock(ports_mutex_);
    for (auto& [name, port] : ports_) end(std::move(port.connection));
    ports_.clear();
}

control::StateReport SharedComponent::report() {
    const std::lock_guard lock(report_mutex_);
    return {name_, shown_state(component_.getStatus(), exited_), ++sequence_};
}

std::string SharedComponent::execute(std::string_view command) {
    if (command == control::activate) {
        // Set before the transition, because peer_lost() may run during it.
        if (component_.getStatus() != OPROS_CS_ACTIVE) started_by_peer_ = true;
        return directory_.transition(name_, TRANSITION_START);
    }
    if (command == control::reset) return directory_.transition(name_, TRANSITION_RECOVER);
    started_by_peer_ = false;
    if (command == control::deactivate) return directory_.transition(name_, TRANSITION_STOP);
    exited_ = true; // set before the transition, which reports the state at once
    return directory_.transition(name_, TRANSITION_DESTROY);
}

void SharedComponent::peer_lost() {
    if (!started_by_peer_.exchange(false)) return;
    const std::string error = directory_.transition(name_, TRANSITION_STOP);
    if (!error.empty()) log::error("{}", error);
}

} // namespace tandem::adaptor
