// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/configuration/own_settings_check.hpp"
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include "host/text/nearest_name.hpp"
#include <algorithm>
#include <coil/stringutil.h>
#include <rtm/RTObject.h>

namespace RTC {
namespace {

bool starts_with(const std::string& text, const std::string& start) {
    return text.compare(0, start.size(), start) == 0;
}

/// NAME of `conf.SET.NAME`; empty for other keys, and for sets such as __widget__, which describe parameters.
std::string parameter_of(const std::string& key) {
    const auto dot = key.find('.', 5);
    if (!starts_with(key, "conf.") || starts_with(key, "conf.__") || dot == std::string::npos) return "";
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
        if (starts_with(key.substr(key.find('.', 5) + 1), names.back() + ".")) return "";
    }
    const std::string meant = tandem::text::did_you_mean(parts[2], names);
    return meant.empty() ? "" : key + ": the component has no port " + parts[2] + meant;
}

std::string list(const std::vector<std::string>& names) {
    std::string text;
    for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "none" : text;
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
        if (starts_with(key, "exec_cxt.") || starts_with(key, "ec.") || starts_with(key, "port.")) {
            std::string error = setting_error(key, own_settings.getProperty(key));
            if (error.empty()) error = unknown_port_error(component, key);
            if (!error.empty()) lines.push_back(error);
        } else if (const std::string name = parameter_of(key); !name.empty() && !is_known(name)) {
            lines.push_back(key + ": the component has no parameter " + name +
                            tandem::text::did_you_mean(name, parameters) + " (it has: " + list(parameters) +
                            ")");
        } else if (key.find('.') == std::string::npos && profile.findNode(key) == nullptr && !is_known(key)) {
            // A component may read properties that the manager does not know. Only a name that resembles a parameter is
            // reported.
            const std::string meant = tandem::text::did_you_mean(key, parameters);
            if (!meant.empty()) lines.push_back(key + ": the component has no parameter " + key + meant);
        }
    }
    return lines;
}

} // namespace RTC
