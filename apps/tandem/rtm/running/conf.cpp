// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"

#include <fmt/format.h>
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/NVUtil.h>

namespace tandem::command {
namespace {

// For the message about an unknown parameter.
std::string join_names(const SDOPackage::NVList& values) {
    std::string names;
    for (CORBA::ULong i = 0; i < values.length(); ++i)
        names += (names.empty() ? "" : ", ") + std::string(values[i].name);
    return names.empty() ? "none" : names;
}

// Sets parameters of a configuration set. The whole set is read, changed and written back: OpenRTM has no operation for
// one parameter. Only names that the set has are accepted, since a new one would have no effect.
void set_values(SDOPackage::Configuration_ptr configuration, const ConfOptions& options,
                const std::string& id) {
    SDOPackage::ConfigurationSet_var set = configuration->get_configuration_set(id.c_str());
    for (const auto& assignment : options.values) {
        const std::size_t equals = assignment.find('=');
        if (equals == std::string::npos || equals == 0)
            throw std::runtime_error("`" + assignment + "` is not a parameter; expected NAME=VALUE");
        const std::string name = assignment.substr(0, equals);
        const CORBA::Long index = NVUtil::find_index(set->configuration_data, name.c_str());
        if (index < 0)
            throw std::runtime_error(fmt::format("configuration set {} has no parameter {} (it has: {})", id,
                                                 name, join_names(set->configuration_data)));
        // Values of OpenRTM's parameters are strings in the profile, whatever their C++ type.
        set->configuration_data[static_cast<CORBA::ULong>(index)].value <<=
            assignment.substr(equals + 1).c_str();
    }
    if (!configuration->set_configuration_set_values(set.in()))
        throw std::runtime_error("the component refuses the values");
}

/// All configuration sets with their values; one of them is marked as active.
nlohmann::json sets_json(SDOPackage::Configuration_ptr configuration) {
    const std::string active = active_configuration_set(configuration);
    SDOPackage::ConfigurationSetList_var sets = configuration->get_configuration_sets();
    nlohmann::json json = nlohmann::json::array();
    for (CORBA::ULong i = 0; i < sets->length(); ++i) {
        nlohmann::json values = nlohmann::json::object();
        // toProperties() leaves out values that are no strings.
        for (const auto& key : NVUtil::toProperties(sets[i].configuration_data).propertyNames())
            values[key] = NVUtil::toString(sets[i].configuration_data, key.c_str());
        const std::string id(sets[i].id);
        if (id.compare(0, 2, "__") == 0) continue; // __widget__, __constraints__: hints for graphical editors
        json.push_back({{"set", id}, {"active", id == active}, {"values", values}});
    }
    return json;
}

} // namespace

int rtm_conf(const RtmClientOptions& client_options, const ConfOptions& options) {
    const RtmClient client(client_options);
    const RemoteComponent component = client.find_component(options.component);
    try {
        SDOPackage::Configuration_var configuration = component.object->get_configuration();
        // Without --set the active one. OpenRTM-aist has none before the first activation: then `default`, the set of
        // the parameters' initial values (conf.default.*).
        std::string id = options.set;
        if (id.empty()) id = active_configuration_set(configuration.in());
        if (id.empty()) id = "default";
        // Values are set first: a set that is activated together with them becomes active with the new values.
        if (!options.values.empty()) set_values(configuration.in(), options, id);
        if (!options.activate.empty()) configuration->activate_configuration_set(options.activate.c_str());
        // Read back, so that what is printed is what the component has and not what was asked for.
        const nlohmann::json sets = sets_json(configuration.in());
        if (client_options.json) {
            print_json(sets);
            return 0;
        }
        for (const auto& set : sets) {
            if (!options.set.empty() && set["set"] != options.set) continue;
            print_text(fmt::format("{}{}\n", set["set"].get<std::string>(),
                                   set["active"].get<bool>() ? " (active)" : ""));
            for (const auto& [name, value] : set["values"].items())
                print_text(fmt::format("  {}={}\n", name, value.get<std::string>()));
        }
        return 0;
    } catch (const SDOPackage::InvalidParameter& e) {
        throw std::runtime_error(component.instance + ": " + e.description.in());
    } catch (const SDOPackage::InternalError& e) {
        throw std::runtime_error(component.instance + ": " + e.description.in());
    } catch (const CORBA::Exception& e) {
        throw_corba_error(component.address, e);
    }
}

} // namespace tandem::command
