// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_CONFIGADMIN_H
#define RTC_CONFIGADMIN_H
#include <array>
#include <atomic>
#include <coil/Properties.h>
#include <coil/stringutil.h>
#include <memory>
#include <mutex>
#include <rtm/ConfigurationListener.h>
#include <rtm/ListenerHolder.h>
#include <string>
#include <type_traits>
#include <vector>

namespace RTC {

/// A variable of a component, bound to a configuration parameter.
struct ConfigBase {
    ConfigBase(const char* name_, const char* def_val) : name(name_), default_value(def_val) {}
    virtual ~ConfigBase() = default;
    /// Converts the text into the variable, or the default if the text cannot be converted. Returns true if the text
    /// was new.
    virtual bool update(const char* val) = 0;
    std::string name;
    std::string default_value;
    std::string string_value;
    /// Ours: the variable is a number, and coil::stringTo() converts it.
    bool is_plain_number = false;
};

/// A bound variable of one type. `trans` converts from text.
template <typename VarType>
class Config : public ConfigBase {
  public:
    using Trans = bool (*)(VarType&, const char*);
    Config(const char* name, VarType& var, const char* def_val, Trans trans)
        : ConfigBase(name, def_val), m_var(var), m_trans(trans) {
        is_plain_number = isConvertedByCoil(std::is_arithmetic<VarType>());
    }
    bool update(const char* val) override {
        if (m_set && string_value == val) return false;
        string_value = val;
        m_set = true;
        if (!m_trans(m_var, val)) m_trans(m_var, default_value.c_str());
        return true;
    }

  private:
    bool isConvertedByCoil(std::true_type) const { return m_trans == static_cast<Trans>(coil::stringTo); }
    bool isConvertedByCoil(std::false_type) const { return false; }

    VarType& m_var;
    Trans m_trans;
    bool m_set = false;
};

/// The configuration of a component: named sets of parameters, one of them active. Bound variables change only in
/// update(), which the component calls at its update points, in the thread of its cycle. Changing and choosing sets:
/// [any-thread].
class ConfigAdmin {
  public:
    explicit ConfigAdmin(coil::Properties& configsets) : m_configsets(configsets) {}
    ConfigAdmin(const ConfigAdmin&) = delete;
    ConfigAdmin& operator=(const ConfigAdmin&) = delete;

    /// Binds a variable and sets it at once, to its default or to the value of the active set. Returns false if a
    /// parameter of this name exists or the default cannot be converted.
    template <typename VarType>
    bool bindParameter(const char* param_name, VarType& var, const char* def_val,
                       bool (*trans)(VarType&, const char*) = coil::stringTo) {
        if (param_name == nullptr || def_val == nullptr || isExist(param_name)) return false;
        if (!trans(var, def_val)) return false;
        add(std::unique_ptr<ConfigBase>(new Config<VarType>(param_name, var, def_val, trans)));
        return true;
    }
    /// Returns false if there is no such parameter.
    bool unbindParameter(const char* param_name);

    /// Sets the variables from the active set if the set or its choice has changed.
    void update();
    /// Set all variables, or one of them, from this set, even if it is not active.
    void update(const char* config_set);
    void update(const char* config_set, const char* config_param);

    bool isExist(const char* param_name) const;
    bool isChanged() const { return m_changed; }
    const coil::vstring& changedParameters() const { return m_changedParam; }
    const char* getActiveId() const { return m_activeId.c_str(); }
    bool haveConfig(const char* config_id) const;
    bool isActive() const { return m_active; }

    std::vector<coil::Properties*> getConfigurationSets() const;
    /// Ours: copies of the sets, which stay valid while other threads change and remove sets.
    std::vector<coil::Properties> copies() const;
    std::string activeId() const;
    coil::Properties getConfigurationSet(const char* config_id) const;
    coil::Properties getActiveConfigurationSet() const { return getConfigurationSet(activeId().c_str()); }
    bool setConfigurationSetValues(const coil::Properties& config_set);
    bool addConfigurationSet(const coil::Properties& config_set);
    bool removeConfigurationSet(const char* config_id);
    bool activateConfigurationSet(const char* config_id);

    void addConfigurationParamListener(ConfigurationParamListenerType, ConfigurationParamListener* listener,
                                       bool autoclean = true);
    void removeConfigurationParamListener(ConfigurationParamListenerType,
                                          ConfigurationParamListener* listener);
    void addConfigurationSetListener(ConfigurationSetListenerType type, ConfigurationSetListener* listener,
                                     bool autoclean = true);
    void removeConfigurationSetListener(ConfigurationSetListenerType type,
                                        ConfigurationSetListener* listener);
    void addConfigurationSetNameListener(ConfigurationSetNameListenerType type,
                                         ConfigurationSetNameListener* listener, bool autoclean = true);
    void removeConfigurationSetNameListener(ConfigurationSetNameListenerType type,
                                            ConfigurationSetNameListener* listener);

    // The form of 1.0. The caller keeps ownership of the callbacks.
    void setOnUpdate(OnUpdateCallback* callback) {
        addConfigurationSetNameListener(ON_UPDATE_CONFIG_SET, callback, false);
    }
    void setOnUpdateParam(OnUpdateParamCallback* callback) {
        addConfigurationParamListener(ON_UPDATE_CONFIG_PARAM, callback, false);
    }
    void setOnSetConfigurationSet(OnSetConfigurationSetCallback* callback) {
        addConfigurationSetListener(ON_SET_CONFIG_SET, callback, false);
    }
    void setOnAddConfigurationSet(OnAddConfigurationAddCallback* callback) {
        addConfigurationSetListener(ON_ADD_CONFIG_SET, callback, false);
    }
    void setOnRemoveConfigurationSet(OnRemoveConfigurationSetCallback* callback) {
        addConfigurationSetNameListener(ON_REMOVE_CONFIG_SET, callback, false);
    }
    void setOnActivateSet(OnActivateSetCallback* callback) {
        addConfigurationSetNameListener(ON_ACTIVATE_CONFIG_SET, callback, false);
    }

  private:
    void add(std::unique_ptr<ConfigBase> param);
    void apply(const char* config_set, const char* only_param);
    void notifySet(ConfigurationSetListenerType type, const coil::Properties& set);
    void notifyName(ConfigurationSetNameListenerType type, const char* name);

    std::atomic<bool> m_mustUpdate{
        false}; // update() has work to do; it runs in each cycle and then takes no lock
    mutable std::recursive_mutex m_mutex;
    coil::Properties& m_configsets;
    std::vector<std::unique_ptr<ConfigBase>> m_params;
    std::string m_activeId = "default";
    bool m_active = true;
    bool m_changed = false;
    coil::vstring m_changedParam;
    coil::vstring m_newConfig;
    RTM::util::ListenerHolder<ConfigurationParamListener> m_paramListeners;
    std::array<RTM::util::ListenerHolder<ConfigurationSetListener>, 2> m_setListeners;
    std::array<RTM::util::ListenerHolder<ConfigurationSetNameListener>, 3> m_nameListeners;
};

} // namespace RTC
#endif
