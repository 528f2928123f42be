// SPDX-License-Identifier: Apache-2.0
// Helper functions for references to components, contexts and ports of this or another process. All throw
// CORBA::SystemException if an object cannot be reached. The caller owns returned references.
#ifndef RTC_CORBA_RTCUTIL_H
#define RTC_CORBA_RTCUTIL_H
#include <coil/Properties.h>
#include <coil/stringutil.h>
#include <rtm/RTC.h>
#include <string>
#include <utility>

namespace CORBA_RTCUtil {

coil::Properties get_component_profile(RTC::RTObject_ptr rtc);
bool is_existing(RTC::RTObject_ptr rtc);

/// Returns an owned (0 ...) or participating (1000 ...) context by number, or nil if there is none.
RTC::ExecutionContext_ptr get_actual_ec(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
bool is_alive_in_default_ec(RTC::RTObject_ptr rtc);
RTC::ReturnCode_t activate(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
RTC::ReturnCode_t deactivate(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
RTC::ReturnCode_t reset(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
/// Returns false if there is no such context.
bool get_state(RTC::LifeCycleState& state, RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
bool is_in_inactive(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
bool is_in_active(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
bool is_in_error(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id = 0);
double get_default_rate(RTC::RTObject_ptr rtc);
RTC::ReturnCode_t set_default_rate(RTC::RTObject_ptr rtc, double rate);
double get_current_rate(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id);
RTC::ReturnCode_t set_current_rate(RTC::RTObject_ptr rtc, RTC::UniqueId ec_id, double rate);
/// Returns the number of a component's context, or -1 if the context is not one of the component's.
RTC::UniqueId get_ec_id(RTC::RTObject_ptr rtc, RTC::ExecutionContext_ptr context);
/// Add `other` to, or remove it from, the first context of `rtc`.
RTC::ReturnCode_t add_rtc_to_default_ec(RTC::RTObject_ptr rtc, RTC::RTObject_ptr other);
RTC::ReturnCode_t remove_rtc_to_default_ec(RTC::RTObject_ptr rtc, RTC::RTObject_ptr other);
/// Returns the components in the first context of `rtc`.
RTC::RTCList get_participants_rtc(RTC::RTObject_ptr rtc);

/// Return names of the form `<instance>.<port>`.
coil::vstring get_port_names(RTC::RTObject_ptr rtc);
coil::vstring get_inport_names(RTC::RTObject_ptr rtc);
coil::vstring get_outport_names(RTC::RTObject_ptr rtc);
coil::vstring get_svcport_names(RTC::RTObject_ptr rtc);
/// Finds a port by `<instance>.<port>` or `<port>`. Returns nil if there is none.
RTC::PortService_ptr get_port_by_name(RTC::RTObject_ptr rtc, const std::string& name);

coil::vstring get_connector_names(RTC::PortService_ptr port);
coil::vstring get_connector_names(RTC::RTObject_ptr rtc, const std::string& port_name);
coil::vstring get_connector_ids(RTC::PortService_ptr port);
coil::vstring get_connector_ids(RTC::RTObject_ptr rtc, const std::string& port_name);

/// Returns the profile that connect() uses for a connection of two ports. The caller owns it.
RTC::ConnectorProfile* create_connector(const std::string& name, const coil::Properties& properties,
                                        RTC::PortService_ptr port0, RTC::PortService_ptr port1);
bool already_connected(RTC::PortService_ptr port0, RTC::PortService_ptr port1);
RTC::ReturnCode_t connect(const std::string& name, const coil::Properties& properties,
                          RTC::PortService_ptr port0, RTC::PortService_ptr port1);
RTC::ReturnCode_t connect_by_name(const std::string& name, const coil::Properties& properties,
                                  RTC::RTObject_ptr rtc0, const std::string& port0, RTC::RTObject_ptr rtc1,
                                  const std::string& port1);
/// Connects `port` with each target by a separate connection. Returns the result of the first failure, but makes the
/// other connections.
RTC::ReturnCode_t connect_multi(const std::string& name, const coil::Properties& properties,
                                RTC::PortService_ptr port, RTC::PortServiceList& target_ports);
// Return BAD_PARAMETER if there is no such connection.
RTC::ReturnCode_t disconnect(const RTC::ConnectorProfile& connector);
RTC::ReturnCode_t disconnect_connector_name(RTC::PortService_ptr port, const std::string& connector_name);
RTC::ReturnCode_t disconnect_connector_id(RTC::PortService_ptr port, const std::string& connector_id);
/// Ends all connections of `port` with the port called `other_name`.
RTC::ReturnCode_t disconnect_name(RTC::PortService_ptr port, const std::string& other_name);
RTC::ReturnCode_t disconnect_all(RTC::PortService_ptr port);
// The same functions for a port given by `Name0.port`, rtcname://HOST:PORT/CONTEXT/Name0.port or
// rtcloc://HOST:PORT/Name0.port. Return BAD_PARAMETER, or nil, if it does not exist.
RTC::ReturnCode_t disconnect_connector_name(const std::string& port_name, const std::string& connector_name);
RTC::ReturnCode_t disconnect_connector_id(const std::string& port_name, const std::string& connector_id);
RTC::ReturnCode_t disconnect_all(const std::string& port_name);
RTC::PortService_ptr get_port_by_url(const std::string& port_name);

/// Returns true for the port with this name, `<instance>.<port>`.
struct find_port {
    explicit find_port(std::string name) : m_name(std::move(name)) {}
    bool operator()(RTC::PortService_ptr port) const;
    std::string m_name;
};

coil::Properties get_configuration(RTC::RTObject_ptr rtc, const std::string& set_name);
std::string get_active_configuration_name(RTC::RTObject_ptr rtc);
coil::Properties get_active_configuration(RTC::RTObject_ptr rtc);
std::string get_parameter_by_key(RTC::RTObject_ptr rtc, const std::string& set_name,
                                 const std::string& parameter);
bool set_active_configuration(RTC::RTObject_ptr rtc, const std::string& parameter, const std::string& value);
/// Changes `set` and passes it to the component. Returns whether the component has accepted it.
bool set_configuration_parameter(SDOPackage::Configuration_ptr configuration,
                                 SDOPackage::ConfigurationSet& set, const std::string& parameter,
                                 const std::string& value);
bool set_configuration(RTC::RTObject_ptr rtc, const std::string& set_name, const std::string& parameter,
                       const std::string& value);

} // namespace CORBA_RTCUtil
#endif
