// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/port_properties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace tandem::link {
namespace {

struct PropertyKind {
    std::string_view prefix;
    const char* ports; ///< what they are called in messages
    bool (*is_for)(const Port&);
};

bool has_data(const Port& port) { return is_data_port(port.kind); }
bool has_names(const Port& port) { return !has_data(port) || port.is_event_in_port(); }

bool has_operations(const Port& port) { return !has_data(port); }

constexpr PropertyKind kinds[] = {{"names.", "service port or EventInPort", has_names},
                                  {"operations.", "service port", has_operations},
                                  {"convert.", "data port", has_data},
                                  {"keep_last.", "data port", has_data},
                                  {"wait_ms.", "data port", has_data},
                                  {"deadline_ms.", "data port", has_data}};

} // namespace

std::vector<std::string> find_properties_without_port(const std::vector<std::string>& properties,
                                                      const PortTable& table) {
    std::vector<std::string> lines;
    for (const auto& property : properties) {
        const auto kind = std::find_if(std::begin(kinds), std::end(kinds),
                                       [&](const auto& each) { return property.starts_with(each.prefix); });
        if (kind == std::end(kinds)) continue;
        const std::string name = property.substr(kind->prefix.size());
        const auto* port = table.find(name);
        if (port && kind->is_for(*port)) continue;
        std::string others;
        for (const auto& each : table.ports)
            if (kind->is_for(each)) others += (others.empty() ? "" : ", ") + each.name;
        lines.push_back(fmt::format(
            "property '{}': {} has no {} '{}'; it has {}{}", property, table.component_names(), kind->ports,
            name, others.empty() ? "none" : others, port ? "" : "; it counts when the port is added"));
    }
    return lines;
}

} // namespace tandem::link
