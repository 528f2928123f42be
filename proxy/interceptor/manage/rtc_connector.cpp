// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/manage/rtc_connector.hpp"

#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/interceptor/manage/rtc_lookup.hpp"

#include <fmt/format.h>

namespace tandem::interceptor {
namespace {

using Strings = BuiltInService::Strings;

/// Returns the properties that follow the two ports. A key without a dot, such as `subscription_type`, gets the prefix
/// `dataport.`.
coil::Properties properties_of(const Strings& arguments) {
    coil::Properties properties;
    for (std::size_t i = 2; i < arguments.size(); ++i) {
        const auto& text = arguments[i];
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw OperationFailed(fmt::format("connection property '{}': expected KEY=VALUE", text));
        const std::string key = text.substr(0, equals);
        properties.setProperty(key.find('.') == std::string::npos ? "dataport." + key : key,
                               text.substr(equals + 1));
    }
    if (properties.getProperty("dataport.subscription_type").empty())
        properties.setProperty("dataport.subscription_type", "flush");
    return properties;
}

Strings connect(const Strings& arguments) {
    const auto &from = arguments[0], &to = arguments[1];
    const auto properties = properties_of(arguments);
    RTC::PortService_var source = find_port(from), target = find_port(to);
    require_ok(CORBA_RTCUtil::connect(from + "_" + to, properties, source.in(), target.in()),
               fmt::format("{} is not connected with {}", from, to));
    return {};
}

/// Ends all connections between the two ports.
Strings disconnect(const Strings& arguments) {
    RTC::PortService_var source = find_port(arguments[0]), target = find_port(arguments[1]);
    RTC::ConnectorProfileList_var present = source->get_connector_profiles();
    bool found = false;
    for (CORBA::ULong c = 0; c < present->length(); ++c)
        for (CORBA::ULong p = 0; p < present[c].ports.length(); ++p) {
            if (!present[c].ports[p]->_is_equivalent(target.in())) continue;
            require_ok(source->disconnect(present[c].connector_id),
                       fmt::format("{} is not disconnected from {}", arguments[0], arguments[1]));
            found = true;
            break;
        }
    if (!found) throw OperationFailed(fmt::format("{} is not connected with {}", arguments[0], arguments[1]));
    return {};
}

/// The names of the ports that a port is connected with.
Strings connections(const Strings& arguments) {
    RTC::PortService_var port = find_port(arguments[0]);
    RTC::ConnectorProfileList_var present = port->get_connector_profiles();
    Strings names;
    for (CORBA::ULong c = 0; c < present->length(); ++c)
        for (CORBA::ULong p = 0; p < present[c].ports.length(); ++p) {
            if (present[c].ports[p]->_is_equivalent(port.in())) continue;
            RTC::PortProfile_var profile = present[c].ports[p]->get_port_profile();
            names.emplace_back(profile->name);
        }
    return names;
}

} // namespace

BuiltInService make_rtc_connector() {
    BuiltInService service("RtcConnector");
    service.add("connect", "ssas:", connect);
    service.add("disconnect", "ss:", disconnect);
    service.add("connections", "s:as", connections);
    return service;
}

} // namespace tandem::interceptor
