// SPDX-License-Identifier: Apache-2.0
#include <PortInterface.h>

PortInterface::PortInterface() = default;

// Data and event ports are members of the component and are not deleted here.
PortInterface::~PortInterface() {
    for (auto& [name, port] : m_service) delete port;
}

PortInterface::PortMap* PortInterface::portsOf(PortType type) {
    switch (type) {
    case OPROS_DATA:
    case OPROS_REMOTE_DATA:
        return &m_data;
    case OPROS_EVENT:
        return &m_event;
    case OPROS_SERVICE:
        return &m_service;
    }
    return nullptr;
}

ReturnType PortInterface::addPort(const std::string& name, Port* port) {
    PortMap* ports = port ? portsOf(port->getType()) : nullptr;
    if (!ports) return OPROS_BAD_INPUT_PARAMETER;
    Port*& slot = (*ports)[name];
    // A service port that is replaced is owned by this class; adding the same one again must not delete it.
    if (ports == &m_service && slot != port) delete slot;
    slot = port;
    return OPROS_SUCCESS;
}

Port* PortInterface::getPort(const std::string& name) {
    for (PortMap* ports : {&m_data, &m_event, &m_service})
        if (const auto found = ports->find(name); found != ports->end()) return found->second;
    return nullptr;
}

void PortInterface::portReset() {
    for (PortMap* ports : {&m_data, &m_event, &m_service})
        for (auto& [name, port] : *ports) port->reset();
}

std::vector<std::string> PortInterface::getPortNames(PortType type) const {
    std::vector<std::string> names;
    // portsOf() is not const, as the public header declares it, but changes nothing.
    for (const auto& [name, port] : *const_cast<PortInterface*>(this)->portsOf(type)) names.push_back(name);
    return names;
}
