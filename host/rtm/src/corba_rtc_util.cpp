// SPDX-License-Identifier: Apache-2.0
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/NVUtil.h>

namespace CORBA_RTCUtil {

using RTC::LifeCycleState;
using RTC::RTObject_ptr;
using RTC::UniqueId;

coil::Properties get_component_profile(RTObject_ptr rtc) {
    RTC::ComponentProfile_var profile = rtc->get_component_profile();
    return NVUtil::toProperties(profile->properties);
}

bool is_existing(RTObject_ptr rtc) {
    try {
        return !CORBA::is_nil(rtc) && !rtc->_non_existent();
    } catch (const CORBA::SystemException&) {
        return false;
    }
}

RTC::ExecutionContext_ptr get_actual_ec(RTObject_ptr rtc, UniqueId ec_id) { return rtc->get_context(ec_id); }

bool is_alive_in_default_ec(RTObject_ptr rtc) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc);
    return !CORBA::is_nil(context.in()) && rtc->is_alive(context.in());
}

namespace {

using Transition = RTC::ReturnCode_t (RTC::_objref_ExecutionContext::*)(RTC::LightweightRTObject_ptr);

RTC::ReturnCode_t transit(RTObject_ptr rtc, UniqueId ec_id, Transition transition) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc, ec_id);
    return CORBA::is_nil(context.in()) ? RTC::BAD_PARAMETER : (context.in()->*transition)(rtc);
}

} // namespace

RTC::ReturnCode_t activate(RTObject_ptr rtc, UniqueId ec_id) {
    return transit(rtc, ec_id, &RTC::_objref_ExecutionContext::activate_component);
}
RTC::ReturnCode_t deactivate(RTObject_ptr rtc, UniqueId ec_id) {
    return transit(rtc, ec_id, &RTC::_objref_ExecutionContext::deactivate_component);
}
RTC::ReturnCode_t reset(RTObject_ptr rtc, UniqueId ec_id) {
    return transit(rtc, ec_id, &RTC::_objref_ExecutionContext::reset_component);
}

bool get_state(LifeCycleState& state, RTObject_ptr rtc, UniqueId ec_id) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc, ec_id);
    if (CORBA::is_nil(context.in())) return false;
    state = context->get_component_state(rtc);
    return true;
}

namespace {

bool is_in(LifeCycleState wanted, RTObject_ptr rtc, UniqueId ec_id) {
    LifeCycleState state;
    return get_state(state, rtc, ec_id) && state == wanted;
}

} // namespace

bool is_in_inactive(RTObject_ptr rtc, UniqueId ec_id) { return is_in(RTC::INACTIVE_STATE, rtc, ec_id); }
bool is_in_active(RTObject_ptr rtc, UniqueId ec_id) { return is_in(RTC::ACTIVE_STATE, rtc, ec_id); }
bool is_in_error(RTObject_ptr rtc, UniqueId ec_id) { return is_in(RTC::ERROR_STATE, rtc, ec_id); }

double get_default_rate(RTObject_ptr rtc) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc);
    return CORBA::is_nil(context.in()) ? -1.0 : context->get_rate();
}
RTC::ReturnCode_t set_default_rate(RTObject_ptr rtc, double rate) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc);
    return CORBA::is_nil(context.in()) ? RTC::BAD_PARAMETER : context->set_rate(rate);
}

namespace {

// Names of all ports, or of those of one kind.
coil::vstring names_of(RTObject_ptr rtc, const char* kind) {
    coil::vstring names;
    RTC::PortServiceList_var ports = rtc->get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        RTC::PortProfile_var profile = ports[i]->get_port_profile();
        if (kind == nullptr || NVUtil::isStringValue(profile->properties, "port.port_type", kind))
            names.emplace_back(static_cast<const char*>(profile->name));
    }
    return names;
}

} // namespace

coil::vstring get_port_names(RTObject_ptr rtc) { return names_of(rtc, nullptr); }
coil::vstring get_inport_names(RTObject_ptr rtc) { return names_of(rtc, "DataInPort"); }
coil::vstring get_outport_names(RTObject_ptr rtc) { return names_of(rtc, "DataOutPort"); }
coil::vstring get_svcport_names(RTObject_ptr rtc) { return names_of(rtc, "CorbaPort"); }

RTC::PortService_ptr get_port_by_name(RTObject_ptr rtc, const std::string& name) {
    RTC::PortServiceList_var ports = rtc->get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        RTC::PortProfile_var profile = ports[i]->get_port_profile();
        const std::string full(profile->name);
        if (full == name || full.substr(full.rfind('.') + 1) == name)
            return RTC::PortService::_duplicate(ports[i]);
    }
    return RTC::PortService::_nil();
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

RTC::ReturnCode_t disconnect_all(RTC::PortService_ptr port) { return port->disconnect_all(); }

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

bool set_configuration(RTObject_ptr rtc, const std::string& set_name, const std::string& parameter,
                       const std::string& value) {
    SDOPackage::Configuration_var configuration = rtc->get_configuration();
    SDOPackage::ConfigurationSet_var set = configuration->get_configuration_set(set_name.c_str());
    coil::Properties change;
    change.setProperty(parameter, value);
    NVUtil::mergeFromProperties(set->configuration_data, change);
    return configuration->set_configuration_set_values(set.in());
}

} // namespace CORBA_RTCUtil
