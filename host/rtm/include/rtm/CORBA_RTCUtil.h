// SPDX-License-Identifier: Apache-2.0
// Short forms of what one does with references to components, contexts and ports, in this process or others.
// All throw CORBA::SystemException when an object cannot be reached.
#ifndef RTC_CORBA_RTCUTIL_H
#define RTC_CORBA_RTCUTIL_H
#include <coil/Properties.h>
#include <coil/stringutil.h>
#include <rtm/RTC.h>
#include <string>

namespace CORBA_RTCUtil {

coil::Properties get_component_profile(RTC::RTObject_ptr rtc);
bool is_existing(RTC::RTObject_ptr rtc);

/// Context by number, as owned (0 ...) or participating (1000 ...) context; nil when there is none.
RTC::ExecutionContext_ptr get_actual_ec(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
bool is_alive_in_default_ec(RTC::RTObject_ptr rtc);
RTC::ReturnCode_t activate(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
RTC::ReturnCode_t deactivate(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
RTC::ReturnCode_t reset(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
/// False: there is no such context.
bool get_state(RTC::LifeCycleState& state, RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
bool is_in_inactive(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
bool is_in_active(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
bool is_in_error(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
double get_default_rate(RTC::RTObject_ptr rtc);
RTC::ReturnCode_t set_default_rate(RTC::RTObject_ptr rtc, double rate);

/// Names `<instance>.<port>`.
coil::vstring get_port_names(RTC::RTObject_ptr rtc);
coil::vstring get_inport_names(RTC::RTObject_ptr rtc);
coil::vstring get_outport_names(RTC::RTObject_ptr rtc);
coil::vstring get_svcport_names(RTC::RTObject_ptr rtc);
/// By `<instance>.<port>` or `<port>`; nil when there is none.
RTC::PortService_ptr get_port_by_name(RTC::RTObject_ptr rtc, const std::string& name);

RTC::ConnectorProfile* create_connector(const std::string& name, const coil::Properties& properties,
                                        RTC::PortService_ptr port0, RTC::PortService_ptr port1);
bool already_connected(RTC::PortService_ptr port0, RTC::PortService_ptr port1);
RTC::ReturnCode_t connect(const std::string& name, const coil::Properties& properties, RTC::PortService_ptr port0,
                          RTC::PortService_ptr port1);
RTC::ReturnCode_t connect_by_name(const std::string& name, const coil::Properties& properties, RTC::RTObject_ptr rtc0,
                                  const std::string& port0, RTC::RTObject_ptr rtc1, const std::string& port1);
RTC::ReturnCode_t disconnect_all(RTC::PortService_ptr port);

coil::Properties get_configuration(RTC::RTObject_ptr rtc, const std::string& set_name);
std::string get_active_configuration_name(RTC::RTObject_ptr rtc);
bool set_configuration(RTC::RTObject_ptr rtc, const std::string& set_name, const std::string& parameter,
                       const std::string& value);

} // namespace CORBA_RTCUtil
#endif
