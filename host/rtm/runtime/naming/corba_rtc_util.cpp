// SPDX-License-Identifier: Apache-2.0
// The part of OpenRTM-aist's CORBA_RTCUtil about components, their states and their contexts, with the same
// function names. They are written against the CORBA interfaces alone, so they work for any RT-Component.
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

// Also returns false if its process does not answer.
bool is_existing(RTObject_ptr rtc) {
    try {
        return !CORBA::is_nil(rtc) && !rtc->_non_existent();
    } catch (const CORBA::SystemException&) { // its process does not answer
        return false;
    }
}

// Ids from ECOTHER_OFFSET (1000) on are contexts of other components; 0 is the component's first own one.
RTC::ExecutionContext_ptr get_actual_ec(RTObject_ptr rtc, UniqueId ec_id) { return rtc->get_context(ec_id); }

bool is_alive_in_default_ec(RTObject_ptr rtc) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc);
    return !CORBA::is_nil(context.in()) && rtc->is_alive(context.in());
}

namespace {

using Transition = RTC::ReturnCode_t (RTC::_objref_ExecutionContext::*)(RTC::LightweightRTObject_ptr);

// Requests a transition; the context decides whether the call waits for it (exec_cxt.sync_transition).
RTC::ReturnCode_t request_transition(RTObject_ptr rtc, UniqueId ec_id, Transition transition) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc, ec_id);
    return CORBA::is_nil(context.in()) ? RTC::BAD_PARAMETER : (context.in()->*transition)(rtc);
}

} // namespace

RTC::ReturnCode_t activate(RTObject_ptr rtc, UniqueId ec_id) {
    return request_transition(rtc, ec_id, &RTC::_objref_ExecutionContext::activate_component);
}
RTC::ReturnCode_t deactivate(RTObject_ptr rtc, UniqueId ec_id) {
    return request_transition(rtc, ec_id, &RTC::_objref_ExecutionContext::deactivate_component);
}
RTC::ReturnCode_t reset(RTObject_ptr rtc, UniqueId ec_id) {
    return request_transition(rtc, ec_id, &RTC::_objref_ExecutionContext::reset_component);
}

// Returns false, and leaves `state` unchanged, if the component has no context of this id.
bool get_state(LifeCycleState& state, RTObject_ptr rtc, UniqueId ec_id) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc, ec_id);
    if (CORBA::is_nil(context.in())) return false;
    state = context->get_component_state(rtc);
    return true;
}

namespace {

bool has_state(LifeCycleState expected, RTObject_ptr rtc, UniqueId ec_id) {
    LifeCycleState state;
    return get_state(state, rtc, ec_id) && state == expected;
}

} // namespace

bool is_in_inactive(RTObject_ptr rtc, UniqueId ec_id) { return has_state(RTC::INACTIVE_STATE, rtc, ec_id); }
bool is_in_active(RTObject_ptr rtc, UniqueId ec_id) { return has_state(RTC::ACTIVE_STATE, rtc, ec_id); }
bool is_in_error(RTObject_ptr rtc, UniqueId ec_id) { return has_state(RTC::ERROR_STATE, rtc, ec_id); }

// Returns the rate in Hz, or -1 if there is no such context.
double get_default_rate(RTObject_ptr rtc) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc);
    return CORBA::is_nil(context.in()) ? -1.0 : context->get_rate();
}
RTC::ReturnCode_t set_default_rate(RTObject_ptr rtc, double rate) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc);
    return CORBA::is_nil(context.in()) ? RTC::BAD_PARAMETER : context->set_rate(rate);
}

double get_current_rate(RTObject_ptr rtc, UniqueId ec_id) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc, ec_id);
    return CORBA::is_nil(context.in()) ? -1.0 : context->get_rate();
}
RTC::ReturnCode_t set_current_rate(RTObject_ptr rtc, UniqueId ec_id, double rate) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc, ec_id);
    return CORBA::is_nil(context.in()) ? RTC::BAD_PARAMETER : context->set_rate(rate);
}

// Returns -1 if the component does not take part in the context.
UniqueId get_ec_id(RTObject_ptr rtc, RTC::ExecutionContext_ptr context) {
    return CORBA::is_nil(context) ? -1 : rtc->get_context_handle(context);
}

RTC::ReturnCode_t add_rtc_to_default_ec(RTObject_ptr rtc, RTObject_ptr other) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc);
    return CORBA::is_nil(context.in()) || CORBA::is_nil(other) ? RTC::BAD_PARAMETER
                                                               : context->add_component(other);
}
RTC::ReturnCode_t remove_rtc_to_default_ec(RTObject_ptr rtc, RTObject_ptr other) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc);
    return CORBA::is_nil(context.in()) || CORBA::is_nil(other) ? RTC::BAD_PARAMETER
                                                               : context->remove_component(other);
}

// The members of the component's first context; only the extended interface of a context lists them.
RTC::RTCList get_participants_rtc(RTObject_ptr rtc) {
    RTC::ExecutionContext_var context = get_actual_ec(rtc);
    RTC::ExecutionContextService_var service = RTC::ExecutionContextService::_narrow(context.in());
    if (CORBA::is_nil(service.in())) return RTC::RTCList();
    RTC::ExecutionContextProfile_var profile = service->get_profile();
    return profile->participants;
}

namespace {

// Returns the full names (`Component.port`) of all ports, if `kind` is NULL, or of the ports whose port.port_type is
// `kind`.
coil::vstring list_port_names(RTObject_ptr rtc, const char* kind) {
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

coil::vstring get_port_names(RTObject_ptr rtc) { return list_port_names(rtc, nullptr); }
coil::vstring get_inport_names(RTObject_ptr rtc) { return list_port_names(rtc, "DataInPort"); }
coil::vstring get_outport_names(RTObject_ptr rtc) { return list_port_names(rtc, "DataOutPort"); }
coil::vstring get_svcport_names(RTObject_ptr rtc) { return list_port_names(rtc, "CorbaPort"); }

// Accepts the full name or the part after the dot. Returns nil if the component has no such port.
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

} // namespace CORBA_RTCUtil
