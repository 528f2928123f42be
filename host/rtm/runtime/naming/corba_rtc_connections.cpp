// SPDX-License-Identifier: Apache-2.0
// The part of CORBA_RTCUtil about connections between ports, local or remote. Ports are called through CORBA,
// with the ORB's general time limit; what they cannot do comes as a return code or a CORBA exception.
#include "host/rtm/runtime/naming/remote_names.hpp"
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/Manager.h>
#include <rtm/NVUtil.h>

namespace CORBA_RTCUtil {

using RTC::RTObject_ptr;

namespace {

using ConnectorText = const char* (*)(const RTC::ConnectorProfile&);

// Returns one text for each connector of the port.
coil::vstring list_connectors(RTC::PortService_ptr port, ConnectorText text) {
    coil::vstring texts;
    RTC::ConnectorProfileList_var connectors = port->get_connector_profiles();
    for (CORBA::ULong i = 0; i < connectors->length(); ++i) texts.emplace_back(text(connectors[i]));
    return texts;
}

const char* name_of(const RTC::ConnectorProfile& connector) { return connector.name; }
const char* id_of(const RTC::ConnectorProfile& connector) { return connector.connector_id; }

// Overload for a port by its name. Returns an empty list if the component has no such port.
coil::vstring list_connectors(RTObject_ptr rtc, const std::string& port_name, ConnectorText text) {
    RTC::PortService_var port = get_port_by_name(rtc, port_name);
    return CORBA::is_nil(port.in()) ? coil::vstring() : list_connectors(port.in(), text);
}

// Disconnects the connectors that `predicate` returns true for. Returns BAD_PARAMETER if there are none; otherwise
// RTC_OK, or the last error. Continues after an error, so that one dead peer does not keep the other connections alive.
template <class Predicate>
RTC::ReturnCode_t disconnect_if(RTC::PortService_ptr port, Predicate predicate) {
    RTC::ConnectorProfileList_var connectors = port->get_connector_profiles();
    RTC::ReturnCode_t result = RTC::BAD_PARAMETER;
    for (CORBA::ULong i = 0; i < connectors->length(); ++i) {
        if (!predicate(connectors[i])) continue;
        const RTC::ReturnCode_t disconnected = port->disconnect(connectors[i].connector_id);
        if (result == RTC::BAD_PARAMETER || disconnected != RTC::RTC_OK) result = disconnected;
    }
    return result;
}

} // namespace

coil::vstring get_connector_names(RTC::PortService_ptr port) { return list_connectors(port, name_of); }
coil::vstring get_connector_names(RTObject_ptr rtc, const std::string& port_name) {
    return list_connectors(rtc, port_name, name_of);
}
coil::vstring get_connector_ids(RTC::PortService_ptr port) { return list_connectors(port, id_of); }
coil::vstring get_connector_ids(RTObject_ptr rtc, const std::string& port_name) {
    return list_connectors(rtc, port_name, id_of);
}

bool find_port::operator()(RTC::PortService_ptr port) const {
    RTC::PortProfile_var profile = port->get_port_profile();
    return m_name == static_cast<const char*>(profile->name);
}

// The profile of a connection of one or two ports, pushed by corba_cdr unless the properties say otherwise.
RTC::ConnectorProfile* create_connector(const std::string& name, const coil::Properties& properties,
                                        RTC::PortService_ptr port0, RTC::PortService_ptr port1) {
    RTC::ConnectorProfile_var profile = new RTC::ConnectorProfile;
    profile->name = CORBA::string_dup(name.c_str());
    profile->ports.length(CORBA::is_nil(port1) ? 1 : 2);
    profile->ports[0] = RTC::PortService::_duplicate(port0);
    if (!CORBA::is_nil(port1)) profile->ports[1] = RTC::PortService::_duplicate(port1);
    coil::Properties all(properties);
    if (all.getProperty("dataport.dataflow_type").empty()) all.setProperty("dataport.dataflow_type", "push");
    if (all.getProperty("dataport.interface_type").empty())
        all.setProperty("dataport.interface_type", "corba_cdr");
    NVUtil::copyFromProperties(profile->properties, all);
    return profile._retn();
}

bool already_connected(RTC::PortService_ptr port0, RTC::PortService_ptr port1) {
    RTC::ConnectorProfileList_var present = port0->get_connector_profiles();
    for (CORBA::ULong c = 0; c < present->length(); ++c)
        for (CORBA::ULong p = 0; p < present[c].ports.length(); ++p)
            if (present[c].ports[p]->_is_equivalent(port1)) return true;
    return false;
}

RTC::ReturnCode_t connect(const std::string& name, const coil::Properties& properties,
                          RTC::PortService_ptr port0, RTC::PortService_ptr port1) {
    if (CORBA::is_nil(port0)) return RTC::BAD_PARAMETER;
    RTC::ConnectorProfile_var profile = create_connector(name, properties, port0, port1);
    return port0->connect(profile.inout());
}

RTC::ReturnCode_t connect_by_name(const std::string& name, const coil::Properties& properties,
                                  RTObject_ptr rtc0, const std::string& port0, RTObject_ptr rtc1,
                                  const std::string& port1) {
    RTC::PortService_var a = get_port_by_name(rtc0, port0);
    RTC::PortService_var b = get_port_by_name(rtc1, port1);
    if (CORBA::is_nil(a.in()) || CORBA::is_nil(b.in())) return RTC::BAD_PARAMETER;
    return connect(name, properties, a.in(), b.in());
}

// Connects one port with each of several; ports that it is connected with already are skipped. The first
// error is returned, after all have been tried.
RTC::ReturnCode_t connect_multi(const std::string& name, const coil::Properties& properties,
                                RTC::PortService_ptr port, RTC::PortServiceList& target_ports) {
    RTC::ReturnCode_t result = RTC::RTC_OK;
    for (CORBA::ULong i = 0; i < target_ports.length(); ++i) {
        if (port->_is_equivalent(target_ports[i]) || already_connected(port, target_ports[i])) continue;
        const RTC::ReturnCode_t connected = connect(name, properties, port, target_ports[i]);
        if (result == RTC::RTC_OK) result = connected;
    }
    return result;
}

RTC::ReturnCode_t disconnect(const RTC::ConnectorProfile& connector) {
    if (connector.ports.length() == 0) return RTC::BAD_PARAMETER;
    return connector.ports[0]->disconnect(connector.connector_id);
}
RTC::ReturnCode_t disconnect_connector_name(RTC::PortService_ptr port, const std::string& connector_name) {
    return disconnect_if(port, [&](const RTC::ConnectorProfile& c) { return connector_name == name_of(c); });
}
RTC::ReturnCode_t disconnect_connector_id(RTC::PortService_ptr port, const std::string& connector_id) {
    return disconnect_if(port, [&](const RTC::ConnectorProfile& c) { return connector_id == id_of(c); });
}
// Disconnects from the ports of that name; asks each peer for its profile.
RTC::ReturnCode_t disconnect_name(RTC::PortService_ptr port, const std::string& peer_name) {
    const find_port is_peer(peer_name);
    return disconnect_if(port, [&](const RTC::ConnectorProfile& c) {
        for (CORBA::ULong i = 0; i < c.ports.length(); ++i)
            if (!c.ports[i]->_is_equivalent(port) && is_peer(c.ports[i])) return true;
        return false;
    });
}
RTC::ReturnCode_t disconnect_all(RTC::PortService_ptr port) { return port->disconnect_all(); }

// Resolves `Component.port` of this process, or a rtcname:// or rtcloc:// name. Returns nil if the port is not
// available.
RTC::PortService_ptr get_port_by_url(const std::string& port_name) {
    const std::string component = port_name.substr(0, port_name.rfind('.'));
    const std::string port = port_name.substr(port_name.rfind('.') + 1);
    RTC::Manager& manager = RTC::Manager::instance();
    if (component.find("://") == std::string::npos) {
        RTC::RTObject_impl* local = manager.getComponent(component.c_str());
        if (local == nullptr) return RTC::PortService::_nil();
        RTC::RTObject_var rtc = local->getObjRef();
        return get_port_by_name(rtc.in(), port);
    }
    const auto servers = coil::split(manager.getConfig().getProperty("corba.nameservers"), ",", true);
    try {
        RTC::RTObject_var rtc = RTC::resolve_component(manager.theORB(), component, servers);
        return get_port_by_name(rtc.in(), port);
    } catch (const RTC::RemoteUnavailable&) { // OpenRTM-aist returns nil, too
        return RTC::PortService::_nil();
    }
}

namespace {

// Calls `call` with the port of that name. Returns BAD_PARAMETER if it is not available.
template <class Call>
RTC::ReturnCode_t with_port(const std::string& port_name, Call call) {
    RTC::PortService_var port = get_port_by_url(port_name);
    return CORBA::is_nil(port.in()) ? RTC::BAD_PARAMETER : call(port.in());
}

} // namespace

RTC::ReturnCode_t disconnect_connector_name(const std::string& port_name, const std::string& connector_name) {
    return with_port(port_name,
                     [&](RTC::PortService_ptr p) { return disconnect_connector_name(p, connector_name); });
}
RTC::ReturnCode_t disconnect_connector_id(const std::string& port_name, const std::string& connector_id) {
    return with_port(port_name,
                     [&](RTC::PortService_ptr p) { return disconnect_connector_id(p, connector_id); });
}
RTC::ReturnCode_t disconnect_all(const std::string& port_name) {
    return with_port(port_name, [](RTC::PortService_ptr p) { return disconnect_all(p); });
}

} // namespace CORBA_RTCUtil
