// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/running/running_commands.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"

#include <fmt/format.h>

namespace tandem::command {
namespace {

using nlohmann::json;

/// Accepts NAME=VALUE, the form of `tandem rtm conf`, as NAME and VALUE.
OprosConfOptions split_assignment(OprosConfOptions options) {
    const auto equals = options.name.find('=');
    if (options.value || equals == std::string::npos || equals == 0) return options;
    options.value = options.name.substr(equals + 1);
    options.name.resize(equals);
    return options;
}

} // namespace

// Prints the component's actual values, not the requested ones.
int opros_conf(const OprosClientOptions& client_options, const OprosConfOptions& given) {
    const OprosConfOptions options = split_assignment(given);
    const RunningComponent component = find_running_component(client_options, options.component);
    json request = json::object();
    if (!options.name.empty()) request["name"] = options.name;
    if (options.value) request["value"] = *options.value;
    const json reply = request_component(client_options, component, "conf", request);
    const json all = reply.value("properties", json::object());
    json properties = json::object();
    for (const auto& [name, value] : all.items())
        if (options.name.empty() || options.name == name) properties[name] = value;
    if (client_options.json) {
        print_json({{"component", component.name}, {"pid", component.host.pid}, {"properties", properties}});
        return 0;
    }
    for (const auto& [name, value] : properties.items())
        print_text(
            fmt::format("{}={}\n", replace_control_characters(name),
                        value.is_string() ? replace_control_characters(value.get<std::string>()) : ""));
    return 0;
}

} // namespace tandem::command
