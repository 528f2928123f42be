// SPDX-License-Identifier: Apache-2.0
// The part of CORBA_RTCUtil about connections and configurations.
#include "host/rtm/runtime/naming/remote_names.hpp"
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/Manager.h>
#include <rtm/NVUtil.h>

namespace CORBA_RTCUtil {

using RTC::RTObject_ptr;

namespace {

template <class Part>
coil::vstring of_connectors(RTC::PortService_ptr port, Part part) {
    coil::vstring texts;
    RTC::ConnectorProfileList_var connectors = port->get_connector_profiles();
    for (CORBA::ULong i = 0; i < connectors->length(); ++i) texts.emplace_back(part(connectors[i]));
    return texts;
}

const char* name_of(const RTC::ConnectorProfile& connector) { return connector.name; }
const char* id_of(const RTC::ConnectorProfile& connector) { return connector.connector_id; }

coil::vstring of_port(RTObject_ptr rtc, const std::string& port_name,
                      const char* (*part)(const RTC::ConnectorProfile&)) {
    RTC::PortService_var port = get_port_by_name(rtc, port_name);
    return CORBA::is_nil(port.in()) ? coil::vstring() : of_connectors(port.in(), part);
}

// Ends the connections that `chosen` is true for; BAD_PARAMETER when there are none.
template <class Chosen>
RTC::ReturnCode_t disconnect_those(RTC::PortService_ptr port, Chosen chosen) {
    RTC::ConnectorProfileList_var connectors = port->get_connector_profiles();
    RTC::ReturnCode_t result = RTC::BAD_PARAMETER;
    for (CORBA::ULong i = 0; i < connectors->length(); ++i) {
        if (!chosen(connectors[i])) continue;
        const RTC::ReturnCode_t ended = port->disconnect(connectors[i].connector_id);
        if (result == RTC::BAD_PARAMETER || ended != RTC::RTC_OK) result = ended;
    }
    return result;
}

} // namespace

coil::vstring get_connector_names(RTC::PortService_ptr port) { return of_connectors(port, name_of); }
coil::vstring get_connector_names(RTObject_ptr rtc, const std::string& port_name) {
    return of_port(rtc, port_name, name_of);
}
coil::vstring get_connector_ids(RTC::PortService_ptr port) { return of_connectors(port, id_of); }
coil::vstring get_connector_ids(RTObject_ptr rtc, const std::string& port_name) {
    return of_port(rtc, port_name, id_of);
}

bool find_port::operator()(RTC::PortService_ptr port) const {
    RTC::PortProfile_var profile = port->get_port_profile();
    return m_name == static_cast<const char*>(profile->name);
}

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

RTC::ReturnCode_t connect_multi(const std::string& name, const coil::Properties& properties,
                                RTC::PortService_ptr port, RTC::PortServiceList& target_ports) {
    RTC::ReturnCode_t result = RTC::RTC_OK;
    for (CORBA::ULong i = 0; i < target_ports.length(); ++i) {
        if (port->_is_equivalent(target_ports[i]) || already_connected(port, target_ports[i])) continue;
        const RTC::ReturnCode_t made = connect(name, properties, port, target_ports[i]);
        if (result == RTC::RTC_OK) result = made;
    }
    return result;
}

RTC::ReturnCode_t disconnect(const RTC::ConnectorProfile& connector) {
    if (connector.ports.length() == 0) return RTC::BAD_PARAMETER;
    return connector.ports[0]->disconnect(connector.connector_id);
}
RTC::ReturnCode_t disconnect_connector_name(RTC::PortService_ptr port, const std::string& connector_name) {
    return disconnect_those(port,
                            [&](const RTC::ConnectorProfile& c) { return connector_name == name_of(c); });
}
RTC::ReturnCode_t disconnect_connector_id(RTC::PortService_ptr port, const std::string& connector_id) {
    return disconnect_those(port, [&](const RTC::ConnectorProfile& c) { return connector_id == id_of(c); });
}
RTC::ReturnCode_t disconnect_name(RTC::PortService_ptr port, const std::string& other_name) {
    const find_port is_other(other_name);
    return disconnect_those(port, [&](const RTC::ConnectorProfile& c) {
        for (CORBA::ULong i = 0; i < c.ports.length(); ++i)
            if (!c.ports[i]->_is_equivalent(port) && is_other(c.ports[i])) return true;
        return false;
    });
}
RTC::ReturnCode_t disconnect_all(RTC::PortService_ptr port) { return port->disconnect_all(); }

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
    } catch (const RTC::RemoteUnavailable&) { // the answer is nil, as in OpenRTM-aist
        return RTC::PortService::_nil();
    }
}

namespace {

template <class Call>
RTC::ReturnCode_t at_port(const std::string& port_name, Call call) {
    RTC::PortService_var port = get_port_by_url(port_name);
    return CORBA::is_nil(port.in()) ? RTC::BAD_PARAMETER : call(port.in());
}

} // namespace

RTC::ReturnCode_t disconnect_connector_name(const std::string& port_name, const std::string& connector_name) {
    return at_port(port_name,
                   [&](RTC::PortService_ptr p) { return disconnect_connector_name(p, connector_name); });
}
RTC::ReturnCode_t disconnect_connector_id(const std::string& port_name, const std::string& connector_id) {
    return at_port(port_name,
                   [&](RTC::PortService_ptr p) { return disconnect_connector_id(p, connector_id); });
}
RTC::ReturnCode_t disconnect_all(const std::string& port_name) {
    return at_port(port_name, [](RTC::PortService_ptr p) { return disconnect_all(p); });
}

coil::Properties get_configuration(RTObject_ptr rtc, const std::string& set_name) {
    SDOPackage::Configuration_var configuration = rtc->get_configuration();
    SDOPackage::ConfigurationSet_var set = configuration->get_configuration_set(set_name.c_str());
    return NVUtil::toProperties(set->configuration_data);
}

std::string get_active_configuration_name(RTObject_ptr rtc) {
    SDOPackage::Configuration_var configuration = rtc->get_configuration();
    SDOPackage::ConfigurationSet_var set = configuration->get_active_configuration_set();
    return static_cast<const char*>(set->id);
}

coil::Properties get_active_configuration(RTObject_ptr rtc) {
    SDOPackage::Configuration_var configuration = rtc->get_configuration();
    SDOPackage::ConfigurationSet_var set = configuration->get_active_configuration_set();
    return NVUtil::toProperties(set->configuration_data);
}

std::string get_parameter_by_key(RTObject_ptr rtc, const std::string& set_name,
                                 const std::string& parameter) {
    return get_configuration(rtc, set_name).getProperty(parameter);
}

bool set_configuration_parameter(SDOPackage::Configuration_ptr configuration,
                                 SDOPackage::ConfigurationSet& set, const std::string& parameter,
                                 const std::string& value) {
    coil::Properties change;
    change.setProperty(parameter, value);
    NVUtil::mergeFromProperties(set.configuration_data, change);
    return configuration->set_configuration_set_values(set);
}

bool set_active_configuration(RTObject_ptr rtc, const std::string& parameter, const std::string& value) {
    return set_configuration(rtc, get_active_configuration_name(rtc), parameter, value);
}

bool set_configuration(RTObject_ptr rtc, const std::string& set_name, const std::string& parameter,
                       const std::string& value) {
    SDOPackage::Configuration_var configuration = rtc->get_configuration();
    SDOPackage::ConfigurationSet_var set = configuration->get_configuration_set(set_name.c_str());
    return set_configuration_parameter(configuration.in(), set.inout(), parameter, value);
}

} // namespace CORBA_RTCUtil
