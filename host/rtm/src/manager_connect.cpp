// SPDX-License-Identifier: Apache-2.0
// preconnect, preactivation, and stepping.
#include "manager_impl.hpp"
#include <rtm/RTObject.h>

namespace RTC {
namespace {

struct ConnectionLine {
    std::vector<std::string> ports;
    coil::Properties properties;
};

bool names_port(const std::string& key) { // port, port1, port2 ...
    return key.compare(0, 4, "port") == 0 && key.find_first_not_of("0123456789", 4) == std::string::npos;
}

// `A.p?port=B.q&key=value...`, or as 1.x has it `A.p:B.q(key=value&...)`.
ConnectionLine parse_connection(const std::string& line) {
    ConnectionLine parsed;
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

} // namespace

void Manager::connectOrThrow(const std::string& line) {
    const ConnectionLine wanted = parse_connection(line);
    PortBase& first = port_of(*this, wanted.ports[0]);
    for (std::size_t i = 1; i < wanted.ports.size(); ++i) {
        PortBase& other = port_of(*this, wanted.ports[i]);
        ConnectorProfile profile;
        profile.name = CORBA::string_dup((wanted.ports[0] + "-" + wanted.ports[i]).c_str());
        profile.ports.length(2);
        profile.ports[0] = first.getPortRef();
        profile.ports[1] = other.getPortRef();
        NVUtil::copyFromProperties(profile.properties, wanted.properties);
        if (first.connect(profile) != RTC_OK)
            throw ManagerError(wanted.ports[0] + " and " + wanted.ports[i] +
                               " cannot be connected: " + first.connectError());
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
