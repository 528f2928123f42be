// SPDX-License-Identifier: Apache-2.0
// The part of CORBA_RTCUtil about configuration sets of components, local or remote. Errors of a component
// come as CORBA exceptions, as in OpenRTM-aist.
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/NVUtil.h>

namespace CORBA_RTCUtil {

using RTC::RTObject_ptr;

// The parameters of a set. Our components throw SDOPackage::InternalError for an unknown set.
coil::Properties get_configuration(RTObject_ptr rtc, const std::string& set_name) {
    SDOPackage::Configuration_var configuration = rtc->get_configuration();
    SDOPackage::ConfigurationSet_var set = configuration->get_configuration_set(set_name.c_str());
    return NVUtil::toProperties(set->configuration_data);
}

// The id of the active set, `default` as a rule.
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

// Returns an empty string if the set has no such parameter.
std::string get_parameter_by_key(RTObject_ptr rtc, const std::string& set_name,
                                 const std::string& parameter) {
    return get_configuration(rtc, set_name).getProperty(parameter);
}

// Changes one value of `set` and writes the whole set back, because the interface has no smaller change.
bool set_configuration_parameter(SDOPackage::Configuration_ptr configuration,
                                 SDOPackage::ConfigurationSet& set, const std::string& parameter,
                                 const std::string& value) {
    coil::Properties change;
    change.setProperty(parameter, value);
    NVUtil::mergeFromProperties(set.configuration_data, change);
    return configuration->set_configuration_set_values(set);
}

// Activates the set again, because OpenRTM-aist's components only then use the new values.
bool set_active_configuration(RTObject_ptr rtc, const std::string& parameter, const std::string& value) {
    SDOPackage::Configuration_var configuration = rtc->get_configuration();
    SDOPackage::ConfigurationSet_var set = configuration->get_active_configuration_set();
    return set_configuration_parameter(configuration.in(), set.inout(), parameter, value) &&
           configuration->activate_configuration_set(set->id);
}

// `set_name` becomes the active set, as with OpenRTM-aist.
bool set_configuration(RTObject_ptr rtc, const std::string& set_name, const std::string& parameter,
                       const std::string& value) {
    SDOPackage::Configuration_var configuration = rtc->get_configuration();
    SDOPackage::ConfigurationSet_var set = configuration->get_configuration_set(set_name.c_str());
    return set_configuration_parameter(configuration.in(), set.inout(), parameter, value) &&
           configuration->activate_configuration_set(set_name.c_str());
}

} // namespace CORBA_RTCUtil
