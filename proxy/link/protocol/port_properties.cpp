// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/port_properties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

namespace tandem::link {
namespace {

/// The owner of a setting of a data port.
enum class Of : std::uint8_t { adaptor, sender, receiver };

struct PropertyKind {
    std::string_view prefix;
    const char* ports; ///< the word for the ports in messages
    bool (*is_for)(const Port&);
    Of of;
};

bool has_data(const Port& port) { return is_data_port(port.kind); }
bool has_names(const Port& port) { return !has_data(port) || port.is_event_in_port(); }

bool has_operations(const Port& port) { return !has_data(port); }

constexpr PropertyKind kinds[] = {{"names.", "service port or EventInPort", has_names, Of::adaptor},
                                  {"operations.", "service port", has_operations, Of::adaptor},
                                  {"convert.", "data port", has_data, Of::adaptor},
                                  {"keep_last.", "data port", has_data, Of::sender},
                                  {"wait_ms.", "data port", has_data, Of::sender},
                                  {"deadline_ms.", "data port", has_data, Of::receiver}};

constexpr std::string_view adaptor_properties[] = {
    "link",   "wait",        "call_timeout", "large_kib",  "segment_mib", "group",   "share",
    "strict", "event_ports", "interfaces",   "port_table", "keep_last",   "wait_ms", "deadline_ms"};

const PropertyKind* kind_of(const std::string& property) {
    const auto* kind = std::find_if(std::begin(kinds), std::end(kinds),
                                    [&](const auto& each) { return property.starts_with(each.prefix); });
    return kind == std::end(kinds) ? nullptr : kind;
}

/// Returns true if the setting belongs to this side. The ports belong to the RTC, on the second side.
bool is_of_side(const PropertyKind& kind, const Port& port, shm::Side side) {
    if (kind.of == Of::adaptor) return side == shm::Side::first;
    const auto sender = port.kind == PortKind::data_in ? shm::Side::first : shm::Side::second;
    return (side == sender) == (kind.of == Of::sender);
}

std::string port_settings() {
    std::string names;
    for (const auto& kind : kinds)
        names += (names.empty() ? "" : ", ") + std::string(kind.prefix.substr(0, kind.prefix.size() - 1));
    return names;
}

std::string names_of(const PortTable& table, const PropertyKind& kind) {
    std::string names;
    for (const auto& each : table.ports)
        if (kind.is_for(each)) names += (names.empty() ? "" : ", ") + each.name;
    return names.empty() ? "none" : names;
}

} // namespace

std::vector<std::string> find_properties_without_port(const std::vector<std::string>& properties,
                                                      const PortTable& table, shm::Side side) {
    const bool is_adaptor = side == shm::Side::first;
    const char* const what = is_adaptor ? "property" : "parameter";
    std::vector<std::string> lines;
    for (const auto& property : properties) {
        const auto* kind = kind_of(property);
        if (!kind) continue;
        const std::string name = property.substr(kind->prefix.size());
        const auto* port = table.find(name);
        if (!port || !kind->is_for(*port))
            lines.push_back(fmt::format("{} '{}': {} has no {} '{}'; it has {}{}", what, property,
                                        table.component_names(), kind->ports, name, names_of(table, *kind),
                                        port ? "" : "; it counts when the port is added"));
        else if (!is_of_side(*kind, *port, side))
            lines.push_back(fmt::format(
                "{} '{}' has no effect here: it is one of the side that {}; give it to {}", what, property,
                kind->of == Of::sender     ? "sends"
                : kind->of == Of::receiver ? "receives"
                                           : "connects the ports",
                is_adaptor ? "InterceptorComp" : "AdaptorComp"));
    }
    return lines;
}

bool is_set_by_engine(const std::string& property) {
    return property.starts_with("opros.") || property.starts_with("_opros_");
}

std::vector<std::string> find_unknown_properties(const std::vector<std::string>& properties) {
    const auto is_known = [](const std::string& name) {
        return kind_of(name) || std::find(std::begin(adaptor_properties), std::end(adaptor_properties),
                                          name) != std::end(adaptor_properties);
    };
    std::vector<std::string> lines;
    for (const auto& property : properties)
        if (!is_set_by_engine(property) && !is_known(property))
            lines.push_back(fmt::format("property '{}' is not one of AdaptorComp's and has no effect; {}",
                                        property,
                                        property.find('.') == std::string::npos
                                            ? fmt::format("it has {}", fmt::join(adaptor_properties, ", "))
                                            : "of a port it has " + port_settings()));
    return lines;
}

std::vector<std::string> find_unknown_parameters(const std::vector<std::string>& parameters,
                                                 const PortTable& table) {
    std::vector<std::string> lines;
    for (const auto& parameter : parameters) {
        const auto dot = parameter.find('.');
        if (dot == std::string::npos || kind_of(parameter) || !table.find(parameter.substr(dot + 1)))
            continue;
        lines.push_back(
            fmt::format("parameter '{}' is not one of InterceptorComp's and has no effect; of a port it has "
                        "keep_last, wait_ms and deadline_ms",
                        parameter));
    }
    return lines;
}

} // namespace tandem::link
