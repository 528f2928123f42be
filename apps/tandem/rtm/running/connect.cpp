// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/running.hpp"
#include "apps/tandem/text.hpp"
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

std::string fact(const Port& port, const char* key) {
    return NVUtil::toString(port.profile->properties, key);
}

// What the ports themselves would refuse without saying why; a serializer may make one type of another.
void check(const Port& a, const Port& b, const RTC::ConnectorProfile& profile) {
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

int rtm_connect(const PeerOptions& options, const ConnectOptions& what) {
    const Peers peers(options);
    const Port first = find_port(peers, what.ports.front());
    nlohmann::json json = nlohmann::json::array();
    for (std::size_t i = 1; i < what.ports.size(); ++i) {
        const Port other = find_port(peers, what.ports[i]);
        const std::string names = first.name + " and " + other.name;
        calling(names, [&] {
            const std::string name = what.name.empty() ? first.name + "-" + other.name : what.name;
            RTC::ConnectorProfile_var profile = CORBA_RTCUtil::create_connector(
                name, connection_properties(what.properties), first.object.in(), other.object.in());
            check(first, other, profile.in());
            const RTC::ReturnCode_t code = first.object->connect(profile.inout());
            if (code != RTC::RTC_OK)
                throw std::runtime_error(names + " are not connected: " + text_of(code) +
                                         "; their logs say more");
            const std::string id(profile->connector_id);
            json.push_back({{"ports", {first.name, other.name}}, {"name", name}, {"id", id}});
            if (!options.json) print_text(first.name + " <-> " + other.name + "  " + id + "\n");
        });
    }
    if (options.json) print_json(json);
    return 0;
}

} // namespace tandem::command
