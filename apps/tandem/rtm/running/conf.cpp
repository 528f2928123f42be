// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/conf.hpp"

#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/rtm/running/context_info.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include "host/text/nearest_name.hpp"

#include <coil/stringutil.h>
#include <cstdio>
#include <fmt/format.h>
#include <map>
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/NVUtil.h>
#include <set>
#include <vector>

namespace tandem::command {
namespace {

std::string unknown_parameter_text(const std::string& name, const std::string& set,
                                   const SDOPackage::NVList& values) {
    std::vector<std::string> known;
    for (CORBA::ULong i = 0; i < values.length(); ++i) known.emplace_back(values[i].name);
    return fmt::format("configuration set {} has no parameter {}{} (it has: {})", set, name,
                       text::did_you_mean(name, known),
                       known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")));
}

// Returns whether the set contains hints for graphical editors, such as __widget__ or __constraints__.
bool is_description(const SDOPackage::ConfigurationSet& set) {
    return std::string(set.id).compare(0, 2, "__") == 0;
}

// Returns a parameter's type as declared by RTCBuilder (conf.__type__.NAME); empty if there is none.
std::string declared_type(SDOPackage::Configuration_ptr configuration, const std::string& name) {
    try {
        SDOPackage::ConfigurationSet_var types = configuration->get_configuration_set("__type__");
        return NVUtil::toString(types->configuration_data, name.c_str());
    } catch (const SDOPackage::InternalError&) { // the set does not exist
        return "";
    }
}

bool is_number(const std::string& text) {
    double number = 0;
    return coil::stringTo(number, text.c_str());
}

// Checks values for hosts of OpenRTM-aist, which accept any text and then use the variable's default. Tandem's hosts
// check values themselves. A parameter without a declared type is assumed to be a number if its old value is one.
void check_value(SDOPackage::Configuration_ptr configuration, const std::string& name,
                 const std::string& former, const std::string& value) {
    static const std::set<std::string> number_types = {"short",
                                                       "int",
                                                       "long",
                                                       "long long",
                                                       "unsigned short",
                                                       "unsigned",
                                                       "unsigned int",
                                                       "unsigned long",
                                                       "unsigned long long",
                                                       "float",
                                                       "double",
                                                       "unsigned char",
                                                       "int32_t",
                                                       "int64_t"};
    if (name.find('.') != std::string::npos)
        throw std::runtime_error(fmt::format(
            "{0}={1} was not set: a host of OpenRTM-aist does not pass on a parameter with a dot in its "
            "name; set {0} in a configuration file of the component, or run it in rtm_host",
            name, value));
    if (is_number(value)) return;
    const std::string type = declared_type(configuration, name);
    if (number_types.count(type) > 0)
        throw std::runtime_error(
            fmt::format("{0}={1} was not set: {0} has type {2}, so the component would use its default", name,
                        value, type));
    if (type.empty() && is_number(former))
        print_note("tandem: warning: {0}={1} replaces {2}: if {0} is a number, the component now uses its "
                   "default, because its host does not check values\n",
                   name, value, former);
}

// Sets parameters of a configuration set. Reads, changes and writes the whole set, because OpenRTM has no operation for
// one parameter. Accepts only existing names, because a new one would have no effect.
void set_values(SDOPackage::Configuration_ptr configuration, const ConfOptions& options,
                const std::string& id, bool host_checks) {
    SDOPackage::ConfigurationSet_var set = configuration->get_configuration_set(id.c_str());
    for (const auto& assignment : options.values) {
        const std::size_t equals = assignment.find('=');
        if (equals == std::string::npos || equals == 0)
            throw std::runtime_error("`" + assignment + "` is not a parameter: expected NAME=VALUE");
        const std::string name = assignment.substr(0, equals);
        const CORBA::Long index = NVUtil::find_index(set->configuration_data, name.c_str());
        if (index < 0) throw std::runtime_error(unknown_parameter_text(name, id, set->configuration_data));
        if (!host_checks)
            check_value(configuration, name, NVUtil::toString(set->configuration_data, name.c_str()),
                        assignment.substr(equals + 1));
        // In the profile, values of OpenRTM's parameters are strings, whatever their C++ type is.
        set->configuration_data[static_cast<CORBA::ULong>(index)].value <<=
            assignment.substr(equals + 1).c_str();
    }
    if (!configuration->set_configuration_set_values(set.in()))
        throw std::runtime_error("the component refuses the values");
}

// Returns the only set of a component without an active set. In OpenRTM-aist, changing values deactivates all sets
// until one is activated, and the component does not report which one was active.
std::string only_set(SDOPackage::Configuration_ptr configuration) {
    std::vector<std::string> ids;
    SDOPackage::ConfigurationSetList_var sets = configuration->get_configuration_sets();
    for (CORBA::ULong i = 0; i < sets->length(); ++i)
        if (!is_description(sets[i])) ids.emplace_back(sets[i].id);
    if (ids.size() == 1) return ids.front();
    throw std::runtime_error(
        fmt::format("no configuration set is active; name one with --set and --activate (there are: {})",
                    ids.empty() ? "none" : fmt::format("{}", fmt::join(ids, ", "))));
}

// Activates a set, so that the component uses its values, and verifies the values.
void activate_set(SDOPackage::Configuration_ptr configuration, const ConfOptions& options,
                  const std::string& changed, const std::string& id) {
    configuration->activate_configuration_set(id.c_str());
    SDOPackage::ConfigurationSet_var active = configuration->get_active_configuration_set();
    if (id != static_cast<const char*>(active->id))
        throw std::runtime_error(
            fmt::format("configuration set {} was activated, but the component uses set {}", id,
                        static_cast<const char*>(active->id)));
    if (id != changed) return;
    std::map<std::string, std::string> wanted; // the last value of a repeated name counts
    for (const auto& assignment : options.values)
        wanted[assignment.substr(0, assignment.find('='))] = assignment.substr(assignment.find('=') + 1);
    for (const auto& [name, value] : wanted) {
        const std::string present = NVUtil::toString(active->configuration_data, name.c_str());
        if (present != value)
            throw std::runtime_error(
                fmt::format("{0}={1} was set, but the component reports {0}={2}", name, value, present));
    }
}

// Returns the set of this id among sets_json(). Throws std::runtime_error if there is none.
nlohmann::json find_set(const nlohmann::json& sets, const std::string& id) {
    std::vector<std::string> known;
    for (const auto& set : sets) {
        if (set["set"] == id) return set;
        known.push_back(set["set"]);
    }
    throw std::runtime_error(fmt::format("there is no configuration set {}{} (the component has: {})", id,
                                         text::did_you_mean(id, known), fmt::join(known, ", ")));
}

} // namespace

// Sets values first. Components of OpenRTM-aist use them only after activation of their set, and have no active set
// until then. So the formerly active set is activated again, even if the values belong to another set.
void change_configuration(SDOPackage::Configuration_ptr configuration, const ConfOptions& options,
                          bool host_checks) {
    const std::string active = active_configuration_set(configuration);
    std::string changed = options.set.empty() ? active : options.set;
    if (!options.values.empty()) {
        if (changed.empty()) changed = only_set(configuration);
        set_values(configuration, options, changed, host_checks);
    }
    std::string id = options.activate;
    if (id.empty() && !options.values.empty()) id = options.set.empty() ? changed : active;
    if (!id.empty()) activate_set(configuration, options, changed, id);
}

nlohmann::json sets_json(SDOPackage::Configuration_ptr configuration) {
    const std::string active = active_configuration_set(configuration);
    SDOPackage::ConfigurationSetList_var sets = configuration->get_configuration_sets();
    nlohmann::json json = nlohmann::json::array();
    for (CORBA::ULong i = 0; i < sets->length(); ++i) {
        nlohmann::json values = nlohmann::json::object();
        if (is_description(sets[i])) continue;
        for (CORBA::ULong v = 0; v < sets[i].configuration_data.length(); ++v) {
            const SDOPackage::NameValue& parameter = sets[i].configuration_data[v];
            const char* text = nullptr; // belongs to the value
            if (parameter.value >>= text) values[static_cast<const char*>(parameter.name)] = text;
        }
        const std::string id(sets[i].id);
        json.push_back({{"set", id}, {"active", id == active}, {"values", values}});
    }
    return json;
}

int rtm_conf(const RtmClientOptions& client_options, const ConfOptions& options) {
    const RtmClient client(client_options);
    const RemoteComponent component = client.find_component(options.component);
    call_configuration(component, [&] {
        SDOPackage::Configuration_var configuration = component.object->get_configuration();
        change_configuration(configuration.in(), options,
                             options.values.empty() || is_in_tandem_host(component.object.in()));
        // Prints the component's actual values, not the requested ones.
        nlohmann::json sets = sets_json(configuration.in());
        if (!options.set.empty()) sets = nlohmann::json::array({find_set(sets, options.set)});
        if (client_options.json) return print_json(sets);
        for (const auto& set : sets) {
            print_text(fmt::format("{}{}\n", set["set"].get<std::string>(),
                                   set["active"].get<bool>() ? " (active)" : ""));
            for (const auto& [name, value] : set["values"].items())
                print_text(fmt::format("  {}={}\n", name, value.get<std::string>()));
        }
    });
    return 0;
}

} // namespace tandem::command
