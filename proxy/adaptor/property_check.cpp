// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/property_check.hpp"

#include "proxy/adaptor/names/engine_property.hpp"
#include "proxy/link/protocol/port_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace tandem::adaptor {
namespace {

using link::PortSetting;

bool has_operations(const link::Port& port) { return !link::is_data_port(port.kind); }
bool has_names(const link::Port& port) { return has_operations(port) || port.is_event_in_port(); }

constexpr PortSetting port_properties[] = {{"names", "service port or EventInPort", has_names},
                                           {"operations", "service port", has_operations},
                                           {"convert", "data port", link::has_data},
                                           link::keep_last_setting,
                                           link::wait_ms_setting,
                                           link::deadline_ms_setting};

constexpr link::PortSettings settings{"property", "InterceptorComp", false, port_properties};

constexpr std::string_view own_properties[] = {
    "link",   "wait",        "call_timeout", "large_kib",  "segment_mib", "group",   "share",
    "strict", "event_ports", "interfaces",   "port_table", "keep_last",   "wait_ms", "deadline_ms"};

std::string names_of_port_properties() {
    std::string names;
    for (const auto& each : port_properties) names += (names.empty() ? "" : ", ") + std::string(each.name);
    return names;
}

bool is_known(const std::string& name) {
    return settings.find(name) ||
           std::find(std::begin(own_properties), std::end(own_properties), name) != std::end(own_properties);
}

} // namespace

std::vector<std::string> find_properties_without_port(const std::vector<std::string>& properties,
                                                      const link::PortTable& peer) {
    return link::find_settings_without_port(properties, peer, settings);
}

std::vector<std::string> find_unknown_properties(const std::vector<std::string>& properties) {
    std::vector<std::string> lines;
    for (const auto& property : properties)
        if (!is_set_by_engine(property) && !is_known(property))
            lines.push_back(fmt::format("property '{}' is not one of AdaptorComp's and has no effect; {}",
                                        property,
                                        property.find('.') == std::string::npos
                                            ? fmt::format("it has {}", fmt::join(own_properties, ", "))
                                            : "of a port it has " + names_of_port_properties()));
    return lines;
}

} // namespace tandem::adaptor
