// SPDX-License-Identifier: Apache-2.0
#include "host/opros/control/port_list.hpp"

#include <InputDataPortInterface.h>
#include <InputEventPortInterface.h>
#include <ProvidedServicePort.h>

namespace tandem::control {
namespace {

using nlohmann::json;

json describe_methods(ServicePortInterface& port) {
    json methods = json::array();
    for (auto each = port.getFirst(); each != port.getEnd(); ++each)
        methods.push_back({{"name", each->first}, {"signature", each->second->signature()}});
    return methods;
}

const char* direction_of(Port& port) {
    if (port.getType() == OPROS_SERVICE)
        return dynamic_cast<ProvidedServicePort*>(&port) != nullptr ? "provided" : "required";
    const bool is_input = dynamic_cast<InputDataPortInterface*>(&port) != nullptr ||
                          dynamic_cast<InputEventPortInterface*>(&port) != nullptr;
    return is_input ? "input" : "output";
}

json describe_port(const std::string& name, Port& port) {
    json out{{"name", name}, {"kind", kind_name(port.getType())}, {"direction", direction_of(port)}};
    if (auto* service = dynamic_cast<ServicePortInterface*>(&port)) {
        out["type"] = nullptr;
        out["methods"] = describe_methods(*service);
        return out;
    }
    const opros_any sample = port.sample();
    out["type"] = sample.empty() ? json() : json(sample.type());
    return out;
}

} // namespace

const char* kind_name(PortType type) {
    if (type == OPROS_EVENT) return "event";
    return type == OPROS_SERVICE ? "service" : "data";
}

// Listens first, so that no port is missed.
PortList::PortList(Component& component) : component_(component) {
    component_.addPortListener(this);
    const std::lock_guard lock(mutex_);
    for (const PortType kind : {OPROS_DATA, OPROS_EVENT, OPROS_SERVICE})
        for (const auto& name : component_.getPortNames(kind))
            if (Port* port = component_.getPort(name)) ports_[name] = port;
}

PortList::~PortList() { component_.removePortListener(this); }

json PortList::describe() const {
    json ports = json::array();
    const std::lock_guard lock(mutex_);
    for (const auto& [name, port] : ports_) ports.push_back(describe_port(name, *port));
    return ports;
}

void PortList::portAdded(const std::string& name, Port& port) {
    const std::lock_guard lock(mutex_);
    ports_[name] = &port;
}

void PortList::portRemoved(const std::string& name, Port& port) {
    const std::lock_guard lock(mutex_);
    if (const auto found = ports_.find(name); found != ports_.end() && found->second == &port)
        ports_.erase(found);
}

} // namespace tandem::control
