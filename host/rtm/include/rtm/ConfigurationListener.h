// SPDX-License-Identifier: Apache-2.0
// Listeners to changes of a component's configuration. They run in the thread that causes the change.
#ifndef RTC_CONFIGURATIONLISTENER_H
#define RTC_CONFIGURATIONLISTENER_H
#include <coil/Properties.h>
#include <cstdint>
#include <rtm/ListenerHolder.h>

namespace RTC {

enum class ConfigurationParamListenerType : std::uint8_t {
    ON_UPDATE_CONFIG_PARAM,
    CONFIG_PARAM_LISTENER_NUM
};
enum class ConfigurationSetListenerType : std::uint8_t {
    ON_SET_CONFIG_SET,
    ON_ADD_CONFIG_SET,
    CONFIG_SET_LISTENER_NUM
};
enum class ConfigurationSetNameListenerType : std::uint8_t {
    ON_UPDATE_CONFIG_SET,
    ON_REMOVE_CONFIG_SET,
    ON_ACTIVATE_CONFIG_SET,
    CONFIG_SET_NAME_LISTENER_NUM
};
constexpr auto ON_UPDATE_CONFIG_PARAM = ConfigurationParamListenerType::ON_UPDATE_CONFIG_PARAM;
constexpr auto ON_SET_CONFIG_SET = ConfigurationSetListenerType::ON_SET_CONFIG_SET;
constexpr auto ON_ADD_CONFIG_SET = ConfigurationSetListenerType::ON_ADD_CONFIG_SET;
constexpr auto ON_UPDATE_CONFIG_SET = ConfigurationSetNameListenerType::ON_UPDATE_CONFIG_SET;
constexpr auto ON_REMOVE_CONFIG_SET = ConfigurationSetNameListenerType::ON_REMOVE_CONFIG_SET;
constexpr auto ON_ACTIVATE_CONFIG_SET = ConfigurationSetNameListenerType::ON_ACTIVATE_CONFIG_SET;
constexpr auto CONFIG_PARAM_LISTENER_NUM = ConfigurationParamListenerType::CONFIG_PARAM_LISTENER_NUM;
constexpr auto CONFIG_SET_LISTENER_NUM = ConfigurationSetListenerType::CONFIG_SET_LISTENER_NUM;
constexpr auto CONFIG_SET_NAME_LISTENER_NUM = ConfigurationSetNameListenerType::CONFIG_SET_NAME_LISTENER_NUM;

/// Called when a parameter has been set from a configuration set.
class ConfigurationParamListener {
  public:
    static const char* toString(ConfigurationParamListenerType type);
    virtual ~ConfigurationParamListener() = default;
    virtual void operator()(const char* config_set_name, const char* config_param_name) = 0;
};
/// Called when a configuration set has been changed or added.
class ConfigurationSetListener {
  public:
    static const char* toString(ConfigurationSetListenerType type);
    virtual ~ConfigurationSetListener() = default;
    virtual void operator()(const coil::Properties& config_set) = 0;
};
/// Called when a configuration set has been applied, removed or chosen.
class ConfigurationSetNameListener {
  public:
    static const char* toString(ConfigurationSetNameListenerType type);
    virtual ~ConfigurationSetNameListener() = default;
    virtual void operator()(const char* config_set_name) = 0;
};

} // namespace RTC

extern template class RTM::util::ListenerHolder<RTC::ConfigurationParamListener>;
extern template class RTM::util::ListenerHolder<RTC::ConfigurationSetListener>;
extern template class RTM::util::ListenerHolder<RTC::ConfigurationSetNameListener>;

namespace RTC {

// Names of 1.0.
using OnUpdateCallback = ConfigurationSetNameListener;
using OnUpdateParamCallback = ConfigurationParamListener;
using OnSetConfigurationSetCallback = ConfigurationSetListener;
using OnAddConfigurationAddCallback = ConfigurationSetListener;
using OnRemoveConfigurationSetCallback = ConfigurationSetNameListener;
using OnActivateSetCallback = ConfigurationSetNameListener;

} // namespace RTC
#endif
