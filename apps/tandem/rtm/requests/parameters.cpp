// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/requests/parameters.hpp"

#include "apps/tandem/rtm/running/conf.hpp"
#include "apps/tandem/rtm/running/context_info.hpp"

#include <fmt/format.h>

namespace tandem::command {
namespace {

nlohmann::json active_values(const RemoteComponent& component) {
    SDOPackage::Configuration_var configuration = component.object->get_configuration();
    for (const auto& set : sets_json(configuration.in()))
        if (set["active"].get<bool>()) return set["values"];
    return nlohmann::json::object();
}

/// Converts CORBA exceptions, too, to a one-line error.
template <class Action>
void with_errors(const RemoteComponent& component, Action action) {
    try {
        action();
    } catch (const SDOPackage::InvalidParameter& e) {
        throw std::runtime_error(component.instance + ": " + e.description.in());
    } catch (const SDOPackage::InternalError& e) {
        throw std::runtime_error(component.instance + ": " + e.description.in());
    } catch (const CORBA::Exception& e) {
        throw_corba_error(component.address, e);
    }
}

} // namespace

nlohmann::json read_parameters(HostComponents& components, const nlohmann::json& request) {
    nlohmann::json reply{{"values", nlohmann::json::array()}, {"errors", nlohmann::json::array()}};
    for (const auto& wanted : request.at("components")) {
        try {
            const RemoteComponent component = components.find(wanted.at("pid").get<std::uint32_t>(),
                                                              wanted.at("component").get<std::string>());
            with_errors(component, [&] {
                nlohmann::json entry = wanted;
                entry["values"] = active_values(component);
                reply["values"].push_back(entry);
            });
        } catch (const std::runtime_error& error) {
            reply["errors"].push_back(error.what());
        }
    }
    return reply;
}

void set_parameters(HostComponents& components, const nlohmann::json& request) {
    const RemoteComponent component =
        components.find(request.at("pid").get<std::uint32_t>(), request.at("component").get<std::string>());
    ConfOptions options;
    for (const auto& [name, value] : request.at("values").items())
        options.values.push_back(name + "=" + value.get<std::string>());
    with_errors(component, [&] {
        SDOPackage::Configuration_var configuration = component.object->get_configuration();
        change_configuration(configuration.in(), options, is_in_tandem_host(component.object.in()));
    });
}

} // namespace tandem::command
