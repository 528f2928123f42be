// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/port_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::link {
namespace {

using Of = PortSetting::Of;

bool has_effect(const PortSetting& setting, const Port& port, bool owns_ports) {
    if (setting.of == Of::this_side) return true;
    const bool sends = owns_ports == (port.kind == PortKind::data_out);
    return sends == (setting.of == Of::sender);
}

std::string names_of(const PortTable& table, const PortSetting& setting) {
    std::string names;
    for (const auto& each : table.ports)
        if (setting.is_for(each)) names += (names.empty() ? "" : ", ") + each.name;
    return names.empty() ? "none" : names;
}

} // namespace

const PortSetting* PortSettings::find(std::string_view name) const {
    const auto found = std::find_if(all.begin(), all.end(), [&](const PortSetting& each) {
        return name.starts_with(each.name) && name.substr(each.name.size()).starts_with('.');
    });
    return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> find_settings_without_port(const std::vector<std::string>& names,
                                                    const PortTable& table, const PortSettings& settings) {
    std::vector<std::string> lines;
    for (const auto& name : names) {
        const auto* setting = settings.find(name);
        if (!setting) continue;
        const std::string port_name = name.substr(setting->name.size() + 1);
        const auto* port = table.find(port_name);
        if (!port || !setting->is_for(*port))
            lines.push_back(fmt::format("{} '{}': {} has no {} '{}'; it has {}{}", settings.word, name,
                                        table.component_names(), setting->ports, port_name,
                                        names_of(table, *setting),
                                        port ? "" : "; it counts when the port is added"));
        else if (!has_effect(*setting, *port, settings.owns_ports))
            lines.push_back(fmt::format(
                "{} '{}' has no effect here: it is a setting of the side that {}; give it to {}",
                settings.word, name, setting->of == Of::sender ? "sends" : "receives", settings.peer_proxy));
    }
    return lines;
}

} // namespace tandem::link
