// SPDX-License-Identifier: Apache-2.0
// preconnect, preactivation, and stepping.
#include "host/rtm/runtime/component/local_object.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/RTObject.h>

namespace RTC {
namespace {

bool names_port(const std::string& key) { // port, port1, port2 ...
    return key.compare(0, 4, "port") == 0 && key.find_first_not_of("0123456789", 4) == std::string::npos;
}

} // namespace

// `A.p?port=B.q&key=value...`, or as 1.x has it `A.p:B.q(key=value&...)`.
PreconnectEntry parse_preconnect_entry(const std::string& line) {
    PreconnectEntry parsed;
    const std::size_t question = line.find('?');
    std::string parameters;
    if (question != std::string::npos) {
        parsed.ports.push_back(coil::eraseBothEndsBlank(line.substr(0, question)));
        parameters = line.substr(question + 1);
    } else {
        const std::size_t open = line.find('(');
        parsed.ports = coil::split(line.substr(0, open), ":");
        if (open != std::string::npos) parameters = line.substr(open + 1, line.rfind(')') - open - 1);
    }
    for (const auto& parameter : coil::split(parameters, "&", true)) {
        const std::size_t equals = parameter.find('=');
        if (equals == std::string::npos || equals == 0)
            throw ManagerError("`" + line + "`: expected key=value, found `" + parameter + "`");
        const std::string key = coil::eraseBothEndsBlank(parameter.substr(0, equals));
        const std::string value = coil::eraseBothEndsBlank(parameter.substr(equals + 1));
        if (names_port(key))
            parsed.ports.push_back(value);
        else if (key.compare(0, 5, "port.") == 0 || key.compare(0, 9, "dataport.") == 0)
            parsed.properties.setProperty(key, value);
        else
            parsed.properties.setProperty("dataport." + key, value);
    }
    if (parsed.ports.size() < 2)
        throw ManagerError("`" + line + "` names one port only; expected A.p?port=B.q&...");
    for (auto [key, value] :
         {std::pair("dataport.dataflow_type", "push"), {"dataport.interface_type", "corba_cdr"}})
        if (parsed.properties.getProperty(key).empty()) parsed.properties.setProperty(key, value);
    return parsed;
}

namespace {

std::string names_of(const std::vector<RTObject_impl*>& components) {
    coil::vstring names;
    for (auto* component : components) names.push_back(component->getInstanceName());
    return names.empty() ? "none" : coil::flatten(names);
}

RTObject_impl& component_of(Manager& manager, const std::string& name) {
    if (RTObject_impl* component = manager.getComponent(name.c_str())) return *component;
    throw ManagerError("there is no component " + name + " (there are: " + names_of(manager.getComponents()) +
                       ")");
}

PortBase& port_of(Manager& manager, const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) throw ManagerError("`" + name + "` is no port; expected Component.port");
    RTObject_impl& component = component_of(manager, name.substr(0, dot));
    const std::string port_name = name.substr(dot + 1);
    if (PortBase* port = component.getPortAdmin().getPort(port_name.c_str())) return *port;
    coil::vstring present;
    PortServiceList_var ports = component.get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        PortProfile_var profile = ports[i]->get_port_profile();
        const std::string full(profile->name);
        present.push_back(full.substr(full.rfind('.') + 1));
    }
    throw ManagerError("component " + name.substr(0, dot) + " has no port " + port_name +
                       " (it has: " + (present.empty() ? "none" : coil::flatten(present)) + ")");
}

// rtcname://localhost/ctx/Name0.port -> {rtcname://localhost/ctx/Name0, Name0.port's last part}
std::pair<std::string, std::string> split_port_name(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos || dot < name.rfind('/') + 1)
        throw ManagerError("`" + name + "` is no port; expected rtcname://HOST:PORT/PATH/Component.port");
    return {name.substr(0, dot), name.substr(dot + 1)};
}

std::vector<std::string> name_servers(Manager& manager) { return manager.impl().name_bindings->servers(); }

} // namespace

bool is_remote(const std::string& port_name) { return port_name.find("://") != std::string::npos; }

PortService_ptr find_port(Manager& manager, const std::string& port_name) {
    if (!is_remote(port_name)) return port_of(manager, port_name).getPortRef();
    const auto [component_name, port] = split_port_name(port_name);
    RTObject_var component = resolve_component(manager.theORB(), component_name, name_servers(manager));
    try {
        PortService_var found = CORBA_RTCUtil::get_port_by_name(component.in(), port);
        if (!CORBA::is_nil(found.in())) return found._retn();
        throw RemoteUnavailable(component_name + " has no port " + port + " (it has: " +
                                coil::flatten(CORBA_RTCUtil::get_port_names(component.in())) + ")");
    } catch (const CORBA::SystemException& e) {
        throw RemoteUnavailable(port_name + ": " + describe_exception(e));
    }
}

std::string connect_ports(const PreconnectEntry& line, std::size_t other, PortService_ptr first,
                          PortService_ptr second) {
    const std::string names = line.ports[0] + " and " + line.ports[other];
    ConnectorProfile profile;
    profile.name = CORBA::string_dup((line.ports[0] + "-" + line.ports[other]).c_str());
    profile.ports.length(2);
    profile.ports[0] = PortService::_duplicate(first);
    profile.ports[1] = PortService::_duplicate(second);
    NVUtil::copyFromProperties(profile.properties, line.properties);
    try {
        // A port of ours says why it refuses; it may as well be the second.
        auto here = local_object<PortBase>(is_remote(line.ports[0]) ? second : first);
        const ReturnCode_t result = here ? here->connect(profile) : first->connect(profile);
        if (result == RTC_OK) return static_cast<const char*>(profile.connector_id);
        throw ManagerError(
            names + " cannot be connected: " +
            (here ? here->connectError()
                  : "the first refuses, with code " + std::to_string(static_cast<int>(result))));
    } catch (const CORBA::SystemException& e) {
        throw RemoteUnavailable(names + " cannot be connected: " + describe_exception(e));
    }
}

void Manager::connectOrThrow(const std::string& text) {
    const PreconnectEntry line = parse_preconnect_entry(text);
    Logger& rtclog = m_impl->log;
    for (std::size_t other = 1; other < line.ports.size(); ++other) {
        const bool kept = is_remote(line.ports[0]) || is_remote(line.ports[other]);
        try {
            PortService_var first = find_port(*this, line.ports[0]);
            PortService_var second = find_port(*this, line.ports[other]);
            const std::string id = connect_ports(line, other, first.in(), second.in());
            if (kept) m_impl->connection_keeper->keep_connected(line, other, id, "");
        } catch (const RemoteUnavailable& e) {
            RTC_WARN(("%s; connected when it comes", e.what()));
            m_impl->connection_keeper->keep_connected(line, other, "", e.what());
        }
    }
}

void Manager::activateComponentOrThrow(const std::string& instance_name) {
    RTObject_impl& component = component_of(*this, instance_name);
    Logger& rtclog = m_impl->log;
    RTObject_var self = component.getObjRef();
    for (auto* context : component.getOwnContexts())
        if (context->activateComponent(self.in()) != RTC_OK)
            RTC_ERROR(("%s did not become active, it is in state %s", instance_name.c_str(),
                       ExecutionContextBase::getStateString(context->getComponentState(self.in()))));
}

void Manager::step(const std::string& instance_name) {
    for (auto* context : component_of(*this, instance_name).getOwnContexts()) context->invokeWorker();
}

} // namespace RTC
