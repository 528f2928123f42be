// SPDX-License-Identifier: Apache-2.0
// PortAdmin: the list of a component's ports.
#include "host/process/published/inventory.hpp"
#include "host/rt/periodic_tick.hpp"
#include <algorithm>
#include <rtm/PortAdmin.h>

namespace RTC {

// Returns copies: the functions below call ports without the mutex, and the ports may call back.
std::vector<PortBase*> PortAdmin::ports() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return ports_;
}

std::vector<PortService_var> PortAdmin::delegatedPorts() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return delegated_ports_;
}

// Own ports first, then delegated ones. The caller owns the list.
PortServiceList* PortAdmin::getPortServiceList() const {
    PortServiceList_var list = new PortServiceList;
    for (auto* port : ports()) CORBA_SeqUtil::push_back(list.inout(), PortService_var(port->getPortRef()));
    for (auto& delegated : delegatedPorts()) CORBA_SeqUtil::push_back(list.inout(), delegated);
    return list._retn();
}

PortProfileList PortAdmin::getPortProfileList() const {
    PortProfileList list;
    for (auto* port : ports()) CORBA_SeqUtil::push_back(list, PortProfile_var(port->get_port_profile()).in());
    for (auto& delegated : delegatedPorts()) {
        try {
            CORBA_SeqUtil::push_back(list, PortProfile_var(delegated->get_port_profile()).in());
        } catch (const CORBA::SystemException&) {
            continue; // the port's component, in another process, is gone
        }
    }
    return list;
}

// Holds the mutex, so that no port is removed meanwhile.
void PortAdmin::rehearsePorts() {
    const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (!lock) return;
    const std::int64_t end = tandem::rt::monotonic_ns() + tandem::rt::rehearsal_limit_ns;
    for (auto* port : ports_) {
        port->rehearse();
        if (tandem::rt::monotonic_ns() > end) break;
    }
}

// The name without its instance name is unique within one component.
PortBase* PortAdmin::getPort(const char* port_name) const {
    const std::string wanted(port_name);
    for (auto* port : ports()) {
        const std::string name(port->getName());
        if (name == wanted || name.substr(name.rfind('.') + 1) == wanted) return port;
    }
    return nullptr;
}

PortService_ptr PortAdmin::getPortRef(const char* port_name) const {
    PortBase* port = getPort(port_name);
    return port ? port->getPortRef() : PortService::_nil();
}

bool PortAdmin::addPort(PortBase& port) {
    if (getPort(port.getName()) != nullptr) return false;
    std::lock_guard<std::mutex> lock(mutex_);
    ports_.push_back(&port);
    return true;
}

bool PortAdmin::removePort(PortBase& port) {
    // Disconnects while the port is still listed, because the peers that are notified may ask for the component's
    // ports.
    port.disconnect_all();
    port.deactivateInterfaces();
    std::lock_guard<std::mutex> lock(mutex_);
    auto found = std::find(ports_.begin(), ports_.end(), &port);
    if (found == ports_.end()) return false;
    ports_.erase(found);
    tandem::process::unlist_part(&port);
    return true;
}

bool PortAdmin::addPort(PortService_ptr port) {
    std::lock_guard<std::mutex> lock(mutex_);
    for (auto& delegated : delegated_ports_)
        if (delegated->_is_equivalent(port)) return false;
    delegated_ports_.emplace_back(PortService::_duplicate(port));
    return true;
}

bool PortAdmin::removePort(PortService_ptr port) {
    std::lock_guard<std::mutex> lock(mutex_);
    return std::erase_if(delegated_ports_, [&](auto& delegated) { return delegated->_is_equivalent(port); }) >
           0;
}

void PortAdmin::activatePorts() {
    for (auto* port : ports()) port->activateInterfaces();
}
void PortAdmin::deactivatePorts() {
    for (auto* port : ports()) port->deactivateInterfaces();
}
// Each port is disconnected, removed and then deactivated as a CORBA object.
void PortAdmin::finalizePorts() {
    for (auto* port : ports()) {
        removePort(*port);
        port->retire();
    }
}

} // namespace RTC
