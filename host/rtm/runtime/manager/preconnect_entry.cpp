// SPDX-License-Identifier: Apache-2.0
// Syntax of a preconnect entry, and the connection of its ports. OpenRTM-aist: Manager::initPreConnection()
// and CORBA_RTCUtil::connect().
#include "host/rtm/runtime/manager/preconnect_entry.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/naming/local_object.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include <numeric>
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/RTObject.h>

namespace RTC {
namespace {

bool is_port_key(const std::string& key) { // port, port1, port2 ...
    return key.compare(0, 4, "port") == 0 && key.find_first_not_of("0123456789", 4) == std::string::npos;
}

// Keys without a prefix are those of a data port, as in OpenRTM-aist.
void parse_parameter(const std::string& text, const std::string& parameter, PreconnectEntry& entry) {
    const std::size_t equals = parameter.find('=');
    if (equals == std::string::npos || equals == 0)
        throw ManagerError("`" + text + "`: expected key=value, found `" + parameter + "`");
    const std::string key = coil::eraseBothEndsBlank(parameter.substr(0, equals));
    const std::string value = coil::eraseBothEndsBlank(parameter.substr(equals + 1));
    if (is_port_key(key))
        entry.ports.push_back(value);
    else if (key.compare(0, 5, "port.") == 0 || key.compare(0, 9, "dataport.") == 0)
        entry.properties.setProperty(key, value);
    else
        entry.properties.setProperty("dataport." + key, value);
}

} // namespace

std::vector<std::size_t> PreconnectEntry::connections() const {
    if (ports.size() == 1) return {0};
    std::vector<std::size_t> all(ports.size() - 1);
    std::iota(all.begin(), all.end(), 1U);
    return all;
}

std::string PreconnectEntry::port_names(std::size_t index, const char* separator) const {
    return index == 0 ? ports[0] : ports[0] + separator + ports[index];
}

PreconnectEntry parse_preconnect_entry(const std::string& text) {
    PreconnectEntry entry;
    const std::size_t question_mark = text.find('?');
    std::string parameters;
    if (question_mark != std::string::npos) {
        entry.ports.push_back(coil::eraseBothEndsBlank(text.substr(0, question_mark)));
        parameters = text.substr(question_mark + 1);
    } else { // the form of 1.x
        const std::size_t open = text.find('(');
        entry.ports = coil::split(text.substr(0, open), ":");
        if (open != std::string::npos) parameters = text.substr(open + 1, text.rfind(')') - open - 1);
    }
    for (const auto& parameter : coil::split(parameters, "&", true)) parse_parameter(text, parameter, entry);
    // Without an interface type, the second port has probably been forgotten: Tandem's own types connect two ports.
    if (entry.ports.size() < 2 && entry.properties.getProperty("dataport.interface_type").empty())
        throw ManagerError(
            "`" + text +
            "` names one port only; expected A.p?port=B.q&..., or A.p?interface_type=TYPE&... for "
            "a transport of a library that connects each port by itself");
    for (auto [key, value] :
         {std::pair("dataport.dataflow_type", "push"), {"dataport.interface_type", "corba_cdr"}})
        if (entry.properties.getProperty(key).empty()) entry.properties.setProperty(key, value);
    return entry;
}

namespace {

// The last parts of the names of all ports, for messages.
std::string port_names(RTObject_impl& component) {
    coil::vstring names;
    PortServiceList_var ports = component.get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        PortProfile_var profile = ports[i]->get_port_profile();
        const std::string full(profile->name);
        names.push_back(full.substr(full.rfind('.') + 1));
    }
    return names.empty() ? "none" : coil::flatten(names);
}

PortBase& find_local_port(Manager& manager, const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos)
        throw ManagerError("`" + name + "` is not a port name; expected Component.port");
    RTObject_impl& component = manager.impl().require_component(manager, name.substr(0, dot));
    const std::string port_name = name.substr(dot + 1);
    if (PortBase* port = component.getPortAdmin().getPort(port_name.c_str())) return *port;
    throw ManagerError("component " + name.substr(0, dot) + " has no port " + port_name +
                       " (it has: " + port_names(component) + ")");
}

// rtcname://localhost/ctx/Name0.port -> {rtcname://localhost/ctx/Name0, port}. The host name may have dots,
// too: only a dot after the last slash separates the port.
std::pair<std::string, std::string> split_remote_port_name(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos || dot < name.rfind('/') + 1)
        throw ManagerError("`" + name +
                           "` is not a port name; expected rtcname://HOST:PORT/PATH/Component.port");
    return {name.substr(0, dot), name.substr(dot + 1)};
}

} // namespace

bool is_remote(const std::string& port_name) { return port_name.find("://") != std::string::npos; }

PortService_ptr find_port(Manager& manager, const std::string& port_name) {
    if (!is_remote(port_name)) return find_local_port(manager, port_name).getPortRef();
    const auto [component_name, port] = split_remote_port_name(port_name);
    RTObject_var component =
        resolve_component(manager.theORB(), component_name, manager.impl().name_bindings->servers());
    try {
        PortService_var found = CORBA_RTCUtil::get_port_by_name(component.in(), port);
        if (!CORBA::is_nil(found.in())) return found._retn();
        // Not a ManagerError: a component may add its ports later.
        throw RemoteUnavailable(component_name + " has no port " + port + " (it has: " +
                                coil::flatten(CORBA_RTCUtil::get_port_names(component.in())) + ")");
    } catch (const CORBA::SystemException& e) {
        throw RemoteUnavailable(port_name + ": " + describe_exception(e));
    }
}

std::string connect_ports(const PreconnectEntry& entry, std::size_t index, PortService_ptr first,
                          PortService_ptr second) {
    const bool alone = index == 0;
    const std::string names = entry.port_names(index, " and ");
    ConnectorProfile profile;
    profile.name = CORBA::string_dup(entry.port_names(index, "-").c_str());
    profile.ports.length(alone ? 1 : 2);
    profile.ports[0] = PortService::_duplicate(first);
    if (!alone) profile.ports[1] = PortService::_duplicate(second);
    NVUtil::copyFromProperties(profile.properties, entry.properties);
    try {
        // connect() may be called on any port of the profile. A local port is preferred, even as the second one,
        // because it keeps the reason for a refusal. CORBA returns only a code.
        auto local = local_object<PortBase>(is_remote(entry.ports[0]) ? second : first);
        const ReturnCode_t result = local ? local->connect(profile) : first->connect(profile);
        if (result == RTC_OK) return static_cast<const char*>(profile.connector_id);
        throw ManagerError(
            names + " cannot be connected: " +
            (local ? local->connectError()
                   : "connect() of the first port returns code " + std::to_string(static_cast<int>(result))));
    } catch (const CORBA::SystemException& e) {
        throw RemoteUnavailable(names + " cannot be connected: " + describe_exception(e));
    }
}

} // namespace RTC
