// SPDX-License-Identifier: Apache-2.0
// Finding, naming and deleting components. OpenRTM-aist: Manager::registerComponent(), getComponents(),
// deleteComponent(), notifyFinalized().
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <algorithm>
#include <rtm/RTObject.h>

namespace RTC {

// Binds the component's names in the name servers, and connects its ports by topic. A server that is not available gets
// the names later, so a failure does not keep the component from running.
bool Manager::registerComponent(RTObject_impl* comp) {
    Logger& rtclog = m_impl->log;
    coil::vstring names = comp->getNamingNames();
    m_impl->listeners.naming_.forEach([&](auto& listener) { listener.preBind(comp, names); });
    RTObject_var ref = comp->getObjRef();
    bool all_bound = true;
    for (const auto& name : names)
        for (const auto& error : m_impl->name_bindings->bind(name, ref.in())) {
            RTC_WARN(("%s", error.c_str()));
            all_bound = false;
        }
    for (const auto& line : m_impl->port_topics->add(ref.in())) RTC_ERROR(("%s", line.c_str()));
    m_impl->listeners.naming_.forEach([&](auto& listener) { listener.postBind(comp, names); });
    return all_bound;
}

bool Manager::unregisterComponent(RTObject_impl* comp) {
    coil::vstring names = comp->getNamingNames();
    m_impl->listeners.naming_.forEach([&](auto& listener) { listener.preUnbind(comp, names); });
    for (const auto& name : names) m_impl->name_bindings->unbind(name);
    m_impl->port_topics->remove(RTObject_var(comp->getObjRef()).in());
    m_impl->listeners.naming_.forEach([&](auto& listener) { listener.postUnbind(comp, names); });
    return true;
}

RTObject_impl* Manager::getComponent(const char* instance_name) {
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    for (auto& component : m_impl->components)
        if (std::string(component.object->getInstanceName()) == instance_name) return component.object;
    return nullptr;
}

std::vector<RTObject_impl*> Manager::getComponents() {
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    std::vector<RTObject_impl*> all;
    for (auto& component : m_impl->components) all.push_back(component.object);
    return all;
}

std::vector<RTObject_var> Manager::Impl::references(const std::function<bool(RTObject_impl&)>& accept) const {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    std::vector<RTObject_var> all;
    for (const auto& component : components)
        if (accept(*component.object)) all.emplace_back(component.object->getObjRef());
    return all;
}

// exit() moves the component to `finalized`, and this function deletes it from there. Within a cycle of the component's
// own context, exit() only requests that, and the main loop does both later.
void Manager::deleteComponent(RTObject_impl* comp) {
    if (comp->exit() == RTC_OK) cleanupComponents();
}

void Manager::deleteComponent(const char* instance_name) {
    if (RTObject_impl* comp = getComponent(instance_name)) deleteComponent(comp);
}

// The last step of RTObject_impl::exit() calls this. Its caller still runs in the component, so cleanupComponents()
// deletes the component later.
void Manager::notifyFinalized(RTObject_impl* comp) {
    unregisterComponent(comp);
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    auto found = std::find_if(m_impl->components.begin(), m_impl->components.end(),
                              [&](auto& entry) { return entry.object == comp; });
    if (found == m_impl->components.end()) return;
    m_impl->finalized.push_back(*found);
    m_impl->components.erase(found);
    invoke([this] { cleanupComponents(); }, std::chrono::milliseconds(100));
}

} // namespace RTC
