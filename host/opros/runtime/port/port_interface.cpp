// SPDX-License-Identifier: Apache-2.0
#include <PortInterface.h>

#include <algorithm>
#include <mutex>

struct opros::detail::port_state {
    mutable std::mutex ports; // guards the three maps
    // Held while listeners are called, so that they receive the changes in order.
    std::mutex changes;
    std::vector<PortListener*> listeners;
    std::vector<Port*> replaced; // owned service ports that a call may still be using
};

namespace {
typedef std::lock_guard<std::mutex> Lock;
} // namespace

PortInterface::PortInterface() : m_state(new opros::detail::port_state) {}

// Data and event ports are members of the component, so they are not deleted here.
PortInterface::~PortInterface() {
    for (auto& [name, port] : m_service) delete port;
    for (Port* port : m_state->replaced) delete port;
    delete m_state;
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
    const Lock change(m_state->changes);
    Port* before = nullptr;
    {
        const Lock lock(m_state->ports);
        Port*& slot = (*ports)[name];
        before = slot;
        slot = port;
    }
    if (before == port) return OPROS_SUCCESS;
    for (PortListener* listener : m_state->listeners) {
        if (before) listener->portRemoved(name, *before);
        listener->portAdded(name, *port);
    }
    // Without listeners there are no connections, so no call can be using the replaced port.
    if (before && ports == &m_service && m_state->listeners.empty())
        delete before;
    else if (before && ports == &m_service)
        m_state->replaced.push_back(before);
    return OPROS_SUCCESS;
}

Port* PortInterface::removePort(const std::string& name) {
    const Lock change(m_state->changes);
    Port* removed = nullptr;
    {
        const Lock lock(m_state->ports);
        removed = find(name);
        if (!removed) return nullptr;
        portsOf(removed->getType())->erase(name);
    }
    for (PortListener* listener : m_state->listeners) listener->portRemoved(name, *removed);
    return removed;
}

void PortInterface::addPortListener(PortListener* listener) {
    const Lock change(m_state->changes);
    m_state->listeners.push_back(listener);
}

void PortInterface::removePortListener(PortListener* listener) {
    const Lock change(m_state->changes);
    auto& all = m_state->listeners;
    all.erase(std::remove(all.begin(), all.end(), listener), all.end());
}

Port* PortInterface::find(const std::string& name) {
    for (PortMap* ports : {&m_data, &m_event, &m_service})
        if (const auto found = ports->find(name); found != ports->end()) return found->second;
    return nullptr;
}

Port* PortInterface::getPort(const std::string& name) {
    const Lock lock(m_state->ports);
    return find(name);
}

void PortInterface::portReset() {
    std::vector<Port*> all;
    {
        const Lock lock(m_state->ports);
        for (PortMap* ports : {&m_data, &m_event, &m_service})
            for (auto& [name, port] : *ports) all.push_back(port);
    }
    for (Port* port : all) port->reset();
}

std::vector<std::string> PortInterface::getPortNames(PortType type) const {
    const Lock lock(m_state->ports);
    std::vector<std::string> names;
    // portsOf() changes nothing, but the public header does not declare it const.
    for (const auto& [name, port] : *const_cast<PortInterface*>(this)->portsOf(type)) names.push_back(name);
    return names;
}
