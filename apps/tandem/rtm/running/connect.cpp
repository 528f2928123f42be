// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include "host/rtm/runtime/port/custom_serializer.hpp"
#include "host/rtm/runtime/port/refusal_reason.hpp"

#include <fmt/format.h>
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/NVUtil.h>

namespace tandem::command {

coil::Properties connection_properties(const std::vector<std::string>& arguments) {
    coil::Properties properties;
    for (const auto& argument : arguments) {
        const std::size_t equals = argument.find('=');
        if (equals == std::string::npos || equals == 0)
            throw std::runtime_error("`" + argument + "` is not a property: expected KEY=VALUE");
        const std::string key = argument.substr(0, equals);
        // Keys of dataport.* are usually given without the prefix, as in manager.components.preconnect.
        const bool is_full_key = key.compare(0, 5, "port.") == 0 || key.compare(0, 9, "dataport.") == 0;
        properties.setProperty(is_full_key ? key : "dataport." + key, argument.substr(equals + 1));
    }
    return properties;
}

void warn_about_properties(const coil::Properties& properties) {
    for (const auto& key : properties.propertyNames())
        if (const auto error = RTC::connector_property_error(key, properties.getProperty(key));
            !error.empty())
            print_note("tandem: warning: {}\n", error);
}

namespace {

// Returns "" if the port does not have the property.
std::string port_property(const RemotePort& port, const char* key) {
    return NVUtil::toString(port.profile->properties, key);
}

// Throws if the two ports cannot be connected, because the return code of their own refusal does not contain the
// reason. Types may differ if the connection names a serializer that converts.
void require_compatible(const RemotePort& a, const RemotePort& b, const RTC::ConnectorProfile& profile) {
    const std::string kind_a = port_property(a, "port.port_type"),
                      kind_b = port_property(b, "port.port_type");
    // A service port fits only a service port. A data port fits a data port of the other direction.
    const bool services = kind_a == "CorbaPort" && kind_b == "CorbaPort";
    if (!services && (kind_a == kind_b || kind_a == "CorbaPort" || kind_b == "CorbaPort"))
        throw std::runtime_error(
            fmt::format("{} is a {}, {} is a {}: they cannot be connected", a.name, kind_a, b.name, kind_b));
    const std::string type_a = port_property(a, "dataport.data_type"),
                      type_b = port_property(b, "dataport.data_type");
    if (!services && type_a != type_b && type_a != "any" && type_b != "any" &&
        !RTC::uses_custom_serializer(profile))
        throw std::runtime_error(fmt::format("{} has type {}, {} has type {}: connect ports of the same type",
                                             a.name, type_a, b.name, type_b));
    if (CORBA_RTCUtil::already_connected(a.object.in(), b.object.in()))
        throw std::runtime_error(a.name + " and " + b.name + " are already connected");
}

// OpenRTM-aist's ports return only a code.
std::string refusal_text(const RTC::ConnectorProfile& profile, RTC::ReturnCode_t code) {
    const std::string reason = RTC::refusal_reason(profile);
    return reason.empty() ? to_string(code) + "; see the logs of their hosts" : reason;
}

} // namespace

// Makes a connection of two ports for each port after the first. Prints each at once, because connections made before a
// failure remain.
int rtm_connect(const RtmClientOptions& client_options, const ConnectOptions& options) {
    const RtmClient client(client_options);
    const RemotePort first = find_port(client, options.ports.front());
    nlohmann::json json = nlohmann::json::array();
    for (std::size_t i = 1; i < options.ports.size(); ++i) {
        const RemotePort other = find_port(client, options.ports[i]);
        const std::string names = first.name + " and " + other.name;
        call_remote(names, [&] {
            const std::string name = options.name.empty() ? first.name + "-" + other.name : options.name;
            coil::Properties properties = connection_properties(options.properties);
            warn_about_properties(properties);
            // See RTC::PortBase::connect(). require_compatible() detects an existing connection.
            if (properties.getProperty("dataport.allow_dup_connection").empty())
                properties.setProperty("dataport.allow_dup_connection", "YES");
            RTC::ConnectorProfile_var profile =
                CORBA_RTCUtil::create_connector(name, properties, first.object.in(), other.object.in());
            require_compatible(first, other, profile.in());
            const RTC::ReturnCode_t code = first.object->connect(profile.inout());
            if (code != RTC::RTC_OK)
                throw std::runtime_error(names + " cannot be connected: " + refusal_text(profile.in(), code));
            const std::string id(profile->connector_id);
            // A port may accept a connection and drop it at once, for example with its first value.
            for (const auto* port : {&first, &other}) {
                RTC::ConnectorProfile_var made = port->object->get_connector_profile(id.c_str());
                if (id != made->connector_id.in())
                    throw std::runtime_error(
                        fmt::format("{} dropped the connection of {} immediately; see its log for the reason",
                                    port->name, names));
            }
            json.push_back({{"ports", {first.name, other.name}}, {"name", name}, {"id", id}});
            if (!client_options.json) print_text(first.name + " <-> " + other.name + "  " + id + "\n");
        });
    }
    if (client_options.json) print_json(json);
    return 0;
}

} // namespace tandem::command
