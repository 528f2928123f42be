// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/settings.hpp"

#include "host/text/split_names.hpp"
#include "proxy/adaptor/names/name_list.hpp"
#include "proxy/link/protocol/setting.hpp"
#include "proxy/wire/operation.hpp"

#include <stdexcept>

namespace tandem::adaptor {
namespace {

double number(const std::map<std::string, std::string>& properties, const std::string& name,
              double default_value) {
    const auto at = properties.find(name);
    return at == properties.end() ? default_value
                                  : link::parse_positive_number("property", name, at->second, default_value);
}

/// Parses `pages=sad:ai, size=:i`. Throws std::runtime_error.
std::vector<link::ServiceOperation> read_operations(const std::string& property, const std::string& text) {
    std::vector<link::ServiceOperation> operations;
    for (const auto& [name, signature] : read_name_pairs(property, text, "OPERATION=ARGUMENTS:RESULT")) {
        try {
            wire::parse_operation(signature);
        } catch (const wire::SignatureError& error) {
            throw std::runtime_error("property '" + property + "': operation '" + name +
                                     "': " + error.what());
        }
        operations.push_back({name, signature});
    }
    return operations;
}

} // namespace

Settings read_settings(const std::map<std::string, std::string>& properties) {
    Settings settings;
    const auto link = properties.find("link");
    if (link == properties.end() || link->second.empty())
        throw std::runtime_error(
            "property 'link' is missing: give it the name that InterceptorComp's 'link' has");
    settings.link = link->second;
    // Users think of the wait in seconds and of a call in milliseconds, so the properties have these units.
    const auto milliseconds = [](double value) {
        return std::chrono::milliseconds(static_cast<long>(value));
    };
    settings.wait = milliseconds(1000 * number(properties, "wait", 10));
    settings.call_timeout = milliseconds(number(properties, "call_timeout", 1000));
    settings.large_bytes = 1024 * static_cast<std::size_t>(number(properties, "large_kib", 0));
    settings.segment_bytes =
        std::size_t{1024} * 1024 * static_cast<std::size_t>(number(properties, "segment_mib", 4));
    if (const auto group = properties.find("group"); group != properties.end())
        settings.group = group->second;
    if (const auto share = properties.find("share"); share != properties.end())
        settings.share = text::split_names(share->second);
    constexpr std::string_view convert = "convert.";
    for (const auto& [name, value] : properties)
        if (name.starts_with(convert)) settings.conversions[name.substr(convert.size())] = value;
    constexpr std::string_view names = "names.";
    for (const auto& [name, value] : properties)
        if (name.starts_with(names))
            settings.names.emplace(name.substr(names.size()), PeerNames(name, value));
    constexpr std::string_view operations = "operations.";
    for (const auto& [name, value] : properties)
        if (name.starts_with(operations))
            settings.operations.emplace(name.substr(operations.size()), read_operations(name, value));
    for (const std::string policy : {"keep_last", "wait_ms", "deadline_ms"})
        for (const auto& [name, value] : properties)
            if (name == policy || name.starts_with(policy + ".")) settings.policies[name] = value;
    if (const auto strict = properties.find("strict"); strict != properties.end())
        settings.strict = link::parse_flag("property", "strict", strict->second);
    if (const auto events = properties.find("event_ports"); events != properties.end())
        settings.event_ports = text::split_names(events->second);
    if (const auto interfaces = properties.find("interfaces"); interfaces != properties.end())
        settings.interfaces =
            read_name_pairs("interfaces", interfaces->second, "COMPONENT.PORT=MODULE::INTERFACE");
    if (const auto table = properties.find("port_table"); table != properties.end())
        settings.port_table = table->second;
    return settings;
}

} // namespace tandem::adaptor
