// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"
#include "host/rtm/runtime/port/custom_serializer.hpp"

#include <fmt/format.h>
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/NVUtil.h>

namespace tandem::command {

coil::Properties connection_properties(const std::vector<std::string>& arguments) {
    coil::Properties properties;
    for (const auto& argument : arguments) {
        const std::size_t equals = argument.find('=');
        if (equals == std::string::npos || equals == 0)
            throw std::runtime_error("`" + argument + "` is no property; expected KEY=VALUE");
        const std::string key = argument.substr(0, equals);
        const bool whole = key.compare(0, 5, "port.") == 0 || key.compare(0, 9, "dataport.") == 0;
        properties.setProperty(whole ? key : "dataport." + key, argument.substr(equals + 1));
    }
    return properties;
}

namespace {

std::string fact(const RemotePort& port, const char* key) {
    return NVUtil::toString(port.profile->properties, key);
}

// What the ports themselves would refuse without saying why; a serializer may make one type of another.
void check(const RemotePort& a, const RemotePort& b, const RTC::ConnectorProfile& profile) {
    const std::string ka = fact(a, "port.port_type"), kb = fact(b, "port.port_type");
    const bool services = ka == "CorbaPort" && kb == "CorbaPort";
    if (!services && (ka == kb || ka == "CorbaPort" || kb == "CorbaPort"))
        throw std::runtime_error(
            fmt::format("{} is a {}, {} is a {}: they cannot be connected", a.name, ka, b.name, kb));
    const std::string ta = fact(a, "dataport.data_type"), tb = fact(b, "dataport.data_type");
    if (!services && ta != tb && ta != "any" && tb != "any" && !RTC::uses_custom_serializer(profile))
        throw std::runtime_error(
            fmt::format("{} carries {}, {} carries {}: connect ports of one type", a.name, ta, b.name, tb));
    if (CORBA_RTCUtil::already_connected(a.object.in(), b.object.in()))
        throw std::runtime_error(a.name + " and " + b.name + " are connected already");
}

} // namespace

int rtm_connect(const RtmClientOptions& client_options, const ConnectOptions& options) {
    const RtmClient client(client_options);
    const RemotePort first = find_port(client, options.ports.front());
    nlohmann::json json = nlohmann::json::array();
    for (std::size_t i = 1; i < options.ports.size(); ++i) {
        const RemotePort other = find_port(client, options.ports[i]);
        const std::string names = first.name + " and " + other.name;
        call_remote(names, [&] {
            const std::string name = options.name.empty() ? first.name + "-" + other.name : options.name;
            RTC::ConnectorProfile_var profile = CORBA_RTCUtil::create_connector(
                name, connection_properties(options.properties), first.object.in(), other.object.in());
            check(first, other, profile.in());
            const RTC::ReturnCode_t code = first.object->connect(profile.inout());
            if (code != RTC::RTC_OK)
                throw std::runtime_error(names + " are not connected: " + text_of(code) +
                                         "; their logs say more");
            const std::string id(profile->connector_id);
            json.push_back({{"ports", {first.name, other.name}}, {"name", name}, {"id", id}});
            if (!client_options.json) print_text(first.name + " <-> " + other.name + "  " + id + "\n");
        });
    }
    if (client_options.json) print_json(json);
    return 0;
}

} // namespace tandem::command
