// SPDX-License-Identifier: Apache-2.0
// The public API for names in name servers, as OpenRTM-aist's class NamingManager, on top of NameBindings. It
// remembers what it has bound itself; names that the manager binds are not in its lists.
#include "host/rtm/runtime/naming/name_bindings.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include <rtm/Manager.h>
#include <rtm/ManagerServant.h>
#include <rtm/NamingManager.h>

namespace RTC {

// CORBA is the only method; OpenRTM-aist also has `manager`, which rtcloc:// names replace here.
void NamingManager::registerNameServer(const char* method, const char* name_server) {
    if (coil::normalize(method) != "corba") {
        RTC_ERROR(("name server %s: unknown method %s, expected corba", name_server, method));
        return;
    }
    m_bindings.add_server(name_server);
    update();
}

void NamingManager::bind(const std::string& name, CORBA::Object_ptr object, const RTObject_impl* component) {
    {
        std::lock_guard<std::mutex> lock(m_mutex);
        m_bound[name] = component;
    }
    for (const auto& error : m_bindings.bind(name, object)) RTC_WARN(("%s", error.c_str()));
}

void NamingManager::bindObject(const char* name, const RTObject_impl* rtobj) {
    bind(name, RTObject_var(rtobj->getObjRef()).in(), rtobj);
}

void NamingManager::bindObject(const char* name, const PortBase* port) {
    bind(name, PortService_var(port->getPortRef()).in(), nullptr);
}

void NamingManager::bindObject(const char* name, const RTM::ManagerServant* mgr) {
    bind(name, RTM::Manager_var(mgr->getObjRef()).in(), nullptr);
}

// The program calls this. The connection keeper does the same at every naming.update.interval.
void NamingManager::update() {
    for (const auto& line : m_bindings.update(true)) RTC_INFO(("%s", line.c_str()));
}

void NamingManager::unbindObject(const char* name) {
    m_bindings.unbind(name);
    std::lock_guard<std::mutex> lock(m_mutex);
    m_bound.erase(name);
}

// Entries are taken out under the mutex and unbound without it, since unbinding calls name servers.
void NamingManager::unbindAll() {
    std::map<std::string, const RTObject_impl*> all;
    {
        std::lock_guard<std::mutex> lock(m_mutex);
        all.swap(m_bound);
    }
    for (const auto& entry : all) m_bindings.unbind(entry.first);
}

// Returns only components that still exist. m_bound may hold pointers to deleted components, which are compared but not
// used.
std::vector<RTObject_impl*> NamingManager::getObjects() {
    std::vector<RTObject_impl*> objects;
    std::lock_guard<std::mutex> lock(m_mutex);
    for (auto* component : m_manager->getComponents())
        for (const auto& entry : m_bound)
            if (entry.second == component) objects.push_back(component);
    return objects;
}

// If a component is not available, logs that and returns an empty list.
RTCList NamingManager::string_to_component(const std::string& name) {
    constexpr unsigned long timeout_ms = 2000;
    std::string reason;
    RTCList found = string_to_component(name, reason, timeout_ms);
    if (!reason.empty()) RTC_WARN(("%s", reason.c_str()));
    return found;
}

// A name without a scheme belongs to this process.
RTCList NamingManager::string_to_component(const std::string& name, std::string& reason,
                                           unsigned long timeout_ms) {
    RTCList found;
    reason.clear();
    RTObject_var component;
    if (parse_remote_name(name).scheme.empty()) {
        if (RTObject_impl* local = m_manager->getComponent(name.c_str())) component = local->getObjRef();
    } else {
        try {
            component = resolve_component(m_manager->theORB(), name, m_bindings.servers(), timeout_ms);
            // The time limit belongs to a reference, and the reference that this one was made from may have another
            // limit.
            omniORB::setClientCallTimeout(component.in(), static_cast<CORBA::ULong>(timeout_ms));
        } catch (const RemoteUnavailable& e) {
            reason = e.what();
        }
    }
    if (!CORBA::is_nil(component.in())) CORBA_SeqUtil::push_back(found, component);
    return found;
}

} // namespace RTC
