// SPDX-License-Identifier: Apache-2.0
#include "host/opros/control/port_list.hpp"

#include "host/opros/control/describe_port.hpp"

namespace tandem::control {
using nlohmann::json;

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
    for (const auto& [name, port] : ports_) {
        ports.push_back(describe_port(*port));
        ports.back()["name"] = name;
    }
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
