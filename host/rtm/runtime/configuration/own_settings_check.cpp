// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/configuration/own_settings_check.hpp"
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include "host/rtm/runtime/configuration/conf_keys.hpp"
#include "host/text/join.hpp"
#include "host/text/nearest_name.hpp"
#include <algorithm>
#include <coil/stringutil.h>
#include <rtm/NVUtil.h>
#include <rtm/RTObject.h>

namespace RTC {
namespace {

/// NAME of `conf.SET.NAME`; empty for other keys, and for sets such as __widget__, which describe parameters.
std::string parameter_of(const std::string& key) {
    const auto dot = key.find('.', 5);
    if (!key.starts_with("conf.") || key.starts_with("conf.__") || dot == std::string::npos) return "";
    const std::string name = key.substr(dot + 1);
    return name == "description" ? "" : name; // of the set
}

void add_once(std::vector<std::string>& names, const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

/// The parameters that the profile of the type declares, and those to which the component has bound a variable.
std::vector<std::string> parameter_names(RTObject_impl& component, const coil::Properties& profile) {
    std::vector<std::string> names;
    for (const auto& key : profile.propertyNames()) add_once(names, parameter_of(key));
    for (const auto& key : component.getProperties().propertyNames())
        if (component.getConfigService().isExist(parameter_of(key).c_str()))
            add_once(names, parameter_of(key));
    return names;
}

/// Returns the error in a key `port.KIND.NAME.OPTION`, for example `port.inport.NAME.OPTION`, if NAME resembles the
/// name of a port. A port that is added later may have any other name.
std::string unknown_port_error(RTObject_impl& component, const std::string& key) {
    const auto parts = coil::split(key, ".");
    if (parts.size() < 4 || parts[0] != "port" || parts[2] == "dataport") return "";
    std::vector<std::string> names;
    ComponentProfile_var profile = component.get_component_profile();
    for (CORBA::ULong i = 0; i < profile->port_profiles.length(); ++i) {
        const std::string name(profile->port_profiles[i].name); // INSTANCE.NAME, and NAME may have dots
        names.push_back(
            name.substr(std::min(name.size(), std::string(component.getInstanceName()).size() + 1)));
        if (key.substr(key.find('.', 5) + 1).starts_with(names.back() + ".")) return "";
    }
    const std::string meant = tandem::text::did_you_mean(parts[2], names);
    return meant.empty() ? "" : key + ": the component has no port " + parts[2] + meant;
}

/// Returns the key of a context's setting that was probably meant by a key without effect; empty if none was. A component
/// may read properties of any name, so only a slight difference counts.
std::string meant_context_setting(const std::string& key) {
    constexpr std::size_t likely_typing_error = 2;
    std::string rate = "exec_cxt.periodic.rate";
    const std::string normal = coil::normalize(key);
    if (normal == "rate" || (normal.starts_with("exec") && normal.ends_with("rate"))) return rate;
    for (const auto& known : conf_keys()) {
        std::string name = known.name;
        if (!name.starts_with("exec_cxt.") || key.size() > 2 * name.size()) continue;
        const bool lacks_begin = key.find('.') != std::string::npos && name.ends_with("." + normal);
        if (lacks_begin || tandem::text::edit_distance(normal, name) <= likely_typing_error) return name;
    }
    return "";
}

/// Returns the error in a key `ec.NAME.OPTION` if the component has no context of that name or type.
std::string unknown_context_error(const std::string& key, RTObject_impl& component) {
    const auto parts = coil::split(key, ".");
    if (parts.size() < 3 || parts[0] != "ec") return "";
    std::vector<std::string> names;
    for (auto* context : component.getOwnContexts()) {
        coil::Properties options;
        NVUtil::copyToProperties(options, ExecutionContextProfile_var(context->getProfile())->properties);
        for (const char* name : {"type", "name"}) add_once(names, options.getProperty(name));
    }
    if (std::find(names.begin(), names.end(), parts[1]) != names.end()) return "";
    return key + ": the component has no execution context " + parts[1] +
           " (it has: " + coil::flatten(names) + ")";
}

std::string list(const std::vector<std::string>& names) {
    return names.empty() ? "none" : tandem::text::join(names, ", ");
}

} // namespace

std::vector<std::string> check_own_settings(RTObject_impl& component, const coil::Properties& profile,
                                            const coil::Properties& own_settings) {
    const auto parameters = parameter_names(component, profile);
    const auto is_known = [&](const std::string& name) {
        return std::find(parameters.begin(), parameters.end(), name) != parameters.end();
    };
    std::vector<std::string> lines;
    for (const auto& key : own_settings.propertyNames()) {
        if (key.starts_with("exec_cxt.") || key.starts_with("ec.") || key.starts_with("port.")) {
            std::string error = setting_error(key, own_settings.getProperty(key));
            if (error.empty()) error = unknown_port_error(component, key);
            if (error.empty()) error = unknown_context_error(key, component);
            if (!error.empty()) lines.push_back(error);
        } else if (const std::string name = parameter_of(key); !name.empty() && !is_known(name)) {
            lines.push_back(key + ": the component has no parameter " + name +
                            tandem::text::did_you_mean(name, parameters) + " (it has: " + list(parameters) +
                            ")");
        } else if (profile.findNode(key) == nullptr && !is_known(key)) {
            // A component may read properties that the manager does not know. Only a name that resembles a parameter or
            // a setting is reported.
            const bool may_be_parameter = key.find('.') == std::string::npos;
            const std::string meant = may_be_parameter ? tandem::text::did_you_mean(key, parameters) : "";
            if (!meant.empty())
                lines.push_back(key + ": the component has no parameter " + key + meant);
            else if (const auto setting = meant_context_setting(key); !setting.empty())
                lines.push_back("unknown key " + key + "; did you mean " + setting + "?");
        }
    }
    return lines;
}

} // namespace RTC
