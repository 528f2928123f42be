// SPDX-License-Identifier: Apache-2.0
// Connects and activates components for rtc.conf, and steps them in lock-step mode. OpenRTM-aist:
// Manager::initPreConnection() and initPreActivation(); step() has no counterpart there.
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/manager/preconnect_entry.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/RTObject.h>

namespace RTC {

RTObject_impl& Manager::Impl::require_component(Manager& manager, const std::string& name) {
    if (RTObject_impl* component = manager.getComponent(name.c_str())) return *component;
    for (const auto& creation : creations())
        if (creation.instance == name)
            throw ManagerError("component " + name + " is still being created: " + creation.text());
    coil::vstring present;
    for (auto* component : manager.getComponents()) present.push_back(component->getInstanceName());
    throw ManagerError("there is no component " + name +
                       " (there are: " + (present.empty() ? "none" : coil::flatten(present)) + ")");
}

// A connection between local ports is made now; otherwise it is an error. A connection with a remote port is handed to
// the connection keeper, which makes it when the other process appears, and again when it comes back.
void Manager::connectOrThrow(const std::string& text) {
    const PreconnectEntry entry = parse_preconnect_entry(text);
    Logger& rtclog = m_impl->log;
    for (const auto& key : entry.properties.propertyNames())
        if (const std::string error = connector_property_error(key, entry.properties.getProperty(key));
            !error.empty())
            warn_about_setting("manager", "manager.components.preconnect: `" + text + "`: " + error);
    for (const std::size_t index : entry.connections()) {
        const bool kept = is_remote(entry.ports[0]) || is_remote(entry.ports[index]);
        try {
            PortService_var first = find_port(*this, entry.ports[0]);
            PortService_var second = find_port(*this, entry.ports[index]);
            const std::string id = connect_ports(entry, index, first.in(), second.in());
            if (kept) m_impl->connection_keeper->keep_connected(entry, index, first.in(), second.in(), id);
        } catch (const InvalidRemoteName& e) {
            throw ManagerError(e.what());
        } catch (const RemoteUnavailable& e) {
            RTC_WARN(("%s; it will be connected when it is available", e.what()));
            m_impl->connection_keeper->connect_when_available(entry, index, e.cause());
        }
    }
}

// A component that fails to become active is in the error state. This is a state of its life cycle and not an error of
// rtc.conf, so it is only logged.
void Manager::activateComponentOrThrow(const std::string& instance_name) {
    m_impl->begin_setup_step("onActivated of component " + instance_name);
    if (!is_remote(instance_name)) return m_impl->activate(m_impl->require_component(*this, instance_name));
    Logger& rtclog = m_impl->log;
    try {
        m_impl->activate_remote(instance_name);
    } catch (const InvalidRemoteName& e) {
        throw ManagerError(e.what());
    } catch (const RemoteUnavailable& e) {
        RTC_WARN(("%s; it will be activated when it is available", e.what()));
        m_impl->connection_keeper->activate_when_available(instance_name, e.cause());
    }
}

void Manager::Impl::activate_remote(const std::string& name) {
    Logger& rtclog = log;
    RTObject_var component = resolve_component(orb.in(), name, name_bindings->servers());
    try {
        const ReturnCode_t code = CORBA_RTCUtil::activate(component.in());
        if (code == RTC_OK || CORBA_RTCUtil::is_in_active(component.in())) {
            RTC_INFO(("%s is active", name.c_str()));
        } else {
            RTC_ERROR(
                ("%s does not become active: its execution context returns code %d; the log of its process "
                 "says why",
                 name.c_str(), static_cast<int>(code)));
        }
    } catch (const CORBA::SystemException& e) {
        throw RemoteUnavailable(name + ": " + describe_exception(e));
    }
}

// A context answers after activation_timeout at the latest, when a slow onActivated may still be running.
void Manager::Impl::activate(RTObject_impl& component) {
    Logger& rtclog = log;
    const std::string name = component.getInstanceName();
    RTObject_var self = component.getObjRef();
    for (auto* context : component.getOwnContexts()) {
        const ReturnCode_t code = context->activateComponent(self.in());
        if (code == RTC_OK) continue;
        const LifeCycleState state = context->getComponentState(self.in());
        const auto running = tandem::crash::find_running_callback(&component);
        if (code != RTC_ERROR) {
            RTC_ERROR(
                ("the execution context of %s refuses to activate it: the component is %s, the context %s",
                 name.c_str(), ExecutionContextBase::getStateString(state),
                 context->isRunning() ? "runs" : "does not run"));
        } else if (running && is_transition_callback(running->name)) {
            RTC_WARN(
                ("%s is still activating: %s has taken %.1f s so far; the host continues and logs its end",
                 name.c_str(), running->name, running->seconds()));
            slow_transitions.expect_end(component);
        } else if (state == INACTIVE_STATE) {
            RTC_WARN(("%s is still INACTIVE: its execution context has not begun the activation, its thread "
                      "is busy",
                      name.c_str()));
        } // else the component's log says which callback has failed
    }
}

void Manager::step(const std::string& instance_name) {
    const auto contexts = m_impl->require_component(*this, instance_name).getOwnContexts();
    for (auto* context : contexts) {
        // Keeps a reference: the component, with its contexts, may be finalized as soon as the cycle is over.
        auto* servant = dynamic_cast<PortableServer::ServantBase*>(context);
        if (servant != nullptr) servant->_add_ref();
        const PortableServer::ServantBase_var kept = servant;
        context->invokeWorker();
    }
}

} // namespace RTC
