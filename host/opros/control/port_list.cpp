// SPDX-License-Identifier: Apache-2.0
#include "host/opros/control/port_list.hpp"

#include "host/opros/control/describe_port.hpp"
#include "host/process/published/inventory.hpp"

namespace tandem::control {
using nlohmann::json;

// Listens first, so that no port is missed.
PortList::PortList(engine::ComponentHost& component) : component_(component) {
    Component& instance = component_.component();
    instance.addPortListener(this);
    const std::lock_guard lock(mutex_);
    for (const PortType kind : {OPROS_DATA, OPROS_EVENT, OPROS_SERVICE})
        for (const auto& name : instance.getPortNames(kind))
            if (Port* port = instance.getPort(name)) add(name, *port);
}

PortList::~PortList() {
    component_.component().removePortListener(this);
    while (!ports_.empty()) remove(ports_.begin()->first);
}

/// The text of a service's type is in the profile only.
void PortList::add(const std::string& name, Port& port) {
    if (ports_.contains(name)) remove(name);
    ports_[name] = &port;
    const json described = describe_port(port);
    std::string type = described["type"].is_string() ? described["type"].get<std::string>() : "";
    for (const auto& listed : component_.profile().service_ports)
        if (listed.name == name) type = listed.type;
    process::list_part(&ports_[name], {"port", component_.name(), name, described["kind"].get<std::string>(),
                                       described["direction"].get<std::string>(), type});
}

void PortList::remove(const std::string& name) {
    const auto found = ports_.find(name);
    process::unlist_part(&found->second);
    ports_.erase(found);
}

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
    add(name, port);
}

void PortList::portRemoved(const std::string& name, Port& port) {
    const std::lock_guard lock(mutex_);
    if (const auto found = ports_.find(name); found != ports_.end() && found->second == &port) remove(name);
}

} // namespace tandem::control
