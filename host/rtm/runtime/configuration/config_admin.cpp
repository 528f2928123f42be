// SPDX-License-Identifier: Apache-2.0
// The configuration sets of one component and the variables that are bound to their parameters, as
// OpenRTM-aist's class ConfigAdmin. Sets are nodes below `conf` of the component's properties. [any-thread]
// While the component runs, its variables change in update() only, which is called between its callbacks: no
// callback sees a half-changed set.
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include "host/rtm/runtime/configuration/parameter_values.hpp"
#include "host/text/nearest_name.hpp"
#include <algorithm>
#include <rtm/ConfigAdmin.h>

namespace RTC {

using Lock = std::lock_guard<std::recursive_mutex>;

namespace {

// The sets are a node of the component's properties.
std::string instance_name(coil::Properties& sets) {
    const coil::Properties* root = sets.getRoot();
    return root == nullptr ? "" : root->getProperty("instance_name");
}

// Returns whether the set has this parameter. The name may have dots, and then is a path of nodes. A node that has
// only child nodes is not a parameter.
bool has_parameter(const coil::Properties& set, const std::string& name) {
    const coil::Properties* node = set.findNode(name);
    return node != nullptr &&
           (node->getLeaf().empty() || *node->getValue() != 0 || *node->getDefaultValue() != 0);
}

// Returns whether a set may have this name. A dot would make it a node below another set.
bool is_set_name(const std::string& id) { return !id.empty() && id.find('.') == std::string::npos; }

} // namespace

void ConfigAdmin::add(std::unique_ptr<ConfigBase> param) {
    Lock lock(m_mutex);
    const std::string name = param->name;
    // A parameter that the profile does not have is listed with its default, so that tools see and set it.
    coil::Properties& set = m_configsets.getNode(m_activeId);
    if (!has_parameter(set, name)) set.setDefault(name, param->default_value);
    m_params.push_back(std::move(param));
    apply(m_activeId.c_str(), name.c_str());
}

bool ConfigAdmin::unbindParameter(const char* param_name) {
    Lock lock(m_mutex);
    auto found =
        std::find_if(m_params.begin(), m_params.end(), [&](auto& p) { return p->name == param_name; });
    if (found == m_params.end()) return false;
    m_params.erase(found);
    return true;
}

// Called by RTObject_impl after onExecute, and around activation and errors. Does nothing unless a set was
// changed or activated since the last call.
void ConfigAdmin::update() {
    if (!m_mustUpdate.load(std::memory_order_acquire)) return;
    Lock lock(m_mutex);
    m_changedParam.clear();
    if (m_changed && m_active) {
        update(m_activeId.c_str()); // if a listener throws, the next call tries again
        m_changed = false;
    }
    m_mustUpdate = !m_changedParam.empty(); // the next call clears the list
}

void ConfigAdmin::update(const char* config_set) {
    Lock lock(m_mutex);
    if (!haveConfig(config_set)) return;
    apply(config_set, nullptr);
    notifyName(ON_UPDATE_CONFIG_SET, config_set);
}

void ConfigAdmin::update(const char* config_set, const char* config_param) {
    Lock lock(m_mutex);
    apply(config_set, config_param);
}

// Assigns the values of a set to all bound variables, or to the one of that name. If the variable's type cannot have a
// value, the variable, and the set, get the default instead (ConfigBase::update()).
void ConfigAdmin::apply(const char* config_set, const char* only_param) {
    const coil::Properties* set = m_configsets.hasKey(config_set);
    if (set == nullptr) return;
    for (auto& param : m_params) {
        if (only_param != nullptr && param->name != only_param) continue;
        if (!has_parameter(*set, param->name)) continue;
        const std::string value = set->getProperty(param->name);
        const std::string expected = expected_instead(*param, value);
        if (!param->update(value.c_str())) continue;
        const std::string found =
            "parameter " + param->name + " of configuration set " + config_set + " is " + value;
        if (!expected.empty()) {
            if (!value.empty())
                warn_about_setting(instance_name(m_configsets), found + ", expected " + expected +
                                                                    "; the component uses the default, " +
                                                                    param->default_value);
            // Makes the set show tools the value that the component uses.
            m_configsets.getNode(config_set).setProperty(param->name, param->default_value);
        } else if (const std::string plain = expected_alone(*param, value); !plain.empty()) {
            const std::string used = used_beginning(*param, value);
            warn_about_setting(instance_name(m_configsets),
                               found + ", expected " + plain + "; the component uses the beginning, " + used);
            m_configsets.getNode(config_set).setProperty(param->name, used);
        }
        m_changedParam.push_back(param->name);
        m_mustUpdate = true;
        m_paramListeners.forEach([&](auto& listener) { listener(config_set, param->name.c_str()); });
    }
}

bool ConfigAdmin::isExist(const char* param_name) const {
    Lock lock(m_mutex);
    return std::any_of(m_params.begin(), m_params.end(), [&](auto& p) { return p->name == param_name; });
}

bool ConfigAdmin::haveConfig(const char* config_id) const {
    Lock lock(m_mutex);
    return m_configsets.hasKey(config_id) != nullptr;
}

std::vector<coil::Properties*> ConfigAdmin::getConfigurationSets() const {
    Lock lock(m_mutex);
    std::vector<coil::Properties*> sets;
    for (auto* set : m_configsets.getLeaf()) sets.push_back(set);
    return sets;
}

// For requests from outside, which run while the component changes its sets. Returns copies, not pointers.
std::vector<coil::Properties> ConfigAdmin::copies() const {
    Lock lock(m_mutex);
    std::vector<coil::Properties> sets;
    for (auto* set : m_configsets.getLeaf()) sets.push_back(*set);
    return sets;
}

std::string ConfigAdmin::activeId() const {
    Lock lock(m_mutex);
    return m_activeId;
}

coil::Properties ConfigAdmin::getConfigurationSet(const char* config_id) const {
    Lock lock(m_mutex);
    const coil::Properties* set = m_configsets.hasKey(config_id);
    return set == nullptr ? coil::Properties(config_id) : *set;
}

// Merges values: parameters that the new set lacks keep their values. A set that does not exist is added. If one of the
// new values does not fit its variable, nothing changes. A parameter that is new to the set and not bound to a variable is
// accepted, as in OpenRTM-aist. It has no effect, and a line in the log says so.
bool ConfigAdmin::setConfigurationSetValues(const coil::Properties& config_set) {
    Lock lock(m_mutex);
    std::string& refused = last_refused_value();
    refused.clear();
    if (!is_set_name(config_set.getName())) return false;
    const coil::Properties present = getConfigurationSet(config_set.getName());
    std::vector<std::string> known;
    for (const auto& param : m_params) {
        known.push_back(param->name);
        const std::string& value = config_set.getProperty(param->name);
        // Tools write whole sets back, so a value that was there before is not a new mistake.
        if (!has_parameter(config_set, param->name) || value == present.getProperty(param->name)) continue;
        std::string expected = expected_instead(*param, value);
        if (expected.empty()) expected = expected_alone(*param, value);
        if (expected.empty()) continue;
        refused = param->name + " is " + value + ", expected " + expected;
        return false;
    }
    for (const auto& name : config_set.propertyNames()) {
        if (present.findNode(name) != nullptr || isExist(name.c_str())) continue;
        warn_about_setting(instance_name(m_configsets), std::string("configuration set ") +
                                                            config_set.getName() + " gets " + name +
                                                            ", which is not a parameter of the component" +
                                                            tandem::text::did_you_mean(name, known));
    }
    if (!haveConfig(config_set.getName())) m_newConfig.push_back(config_set.getName());
    m_configsets.getNode(config_set.getName()) << config_set;
    m_changed = m_mustUpdate = true;
    notifySet(ON_SET_CONFIG_SET, config_set);
    return true;
}

bool ConfigAdmin::addConfigurationSet(const coil::Properties& config_set) {
    Lock lock(m_mutex);
    const std::string id = config_set.getName();
    if (!is_set_name(id) || haveConfig(id.c_str())) return false;
    m_configsets.getNode(config_set.getName()) << config_set;
    m_newConfig.push_back(config_set.getName());
    notifySet(ON_ADD_CONFIG_SET, config_set);
    return true;
}

bool ConfigAdmin::removeConfigurationSet(const char* config_id) {
    Lock lock(m_mutex);
    auto found = std::find(m_newConfig.begin(), m_newConfig.end(), config_id); // sets of the profile stay
    if (m_activeId == config_id || found == m_newConfig.end()) return false;
    delete m_configsets.removeNode(config_id);
    m_newConfig.erase(found);
    notifyName(ON_REMOVE_CONFIG_SET, config_id);
    return true;
}

bool ConfigAdmin::activateConfigurationSet(const char* config_id) {
    Lock lock(m_mutex);
    // Sets whose name begins with __ (__widget__, __constraints__) describe parameters and hold no values.
    if (config_id == nullptr || std::string(config_id).compare(0, 2, "__") == 0 || !haveConfig(config_id))
        return false;
    m_activeId = config_id;
    m_active = true;
    m_changed = m_mustUpdate = true;
    notifyName(ON_ACTIVATE_CONFIG_SET, config_id);
    return true;
}

void ConfigAdmin::notifySet(ConfigurationSetListenerType type, const coil::Properties& set) {
    m_setListeners[static_cast<std::size_t>(type)].forEach([&](auto& listener) { listener(set); });
}
void ConfigAdmin::notifyName(ConfigurationSetNameListenerType type, const char* name) {
    m_nameListeners[static_cast<std::size_t>(type)].forEach([&](auto& listener) { listener(name); });
}

void ConfigAdmin::addConfigurationParamListener(ConfigurationParamListenerType,
                                                ConfigurationParamListener* listener, bool autoclean) {
    m_paramListeners.addListener(listener, autoclean);
}
void ConfigAdmin::removeConfigurationParamListener(ConfigurationParamListenerType,
                                                   ConfigurationParamListener* listener) {
    m_paramListeners.removeListener(listener);
}
void ConfigAdmin::addConfigurationSetListener(ConfigurationSetListenerType type,
                                              ConfigurationSetListener* listener, bool autoclean) {
    m_setListeners.at(static_cast<std::size_t>(type)).addListener(listener, autoclean);
}
void ConfigAdmin::removeConfigurationSetListener(ConfigurationSetListenerType type,
                                                 ConfigurationSetListener* listener) {
    m_setListeners.at(static_cast<std::size_t>(type)).removeListener(listener);
}
void ConfigAdmin::addConfigurationSetNameListener(ConfigurationSetNameListenerType type,
                                                  ConfigurationSetNameListener* listener, bool autoclean) {
    m_nameListeners.at(static_cast<std::size_t>(type)).addListener(listener, autoclean);
}
void ConfigAdmin::removeConfigurationSetNameListener(ConfigurationSetNameListenerType type,
                                                     ConfigurationSetNameListener* listener) {
    m_nameListeners.at(static_cast<std::size_t>(type)).removeListener(listener);
}

} // namespace RTC
