// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/running/running_commands.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace tandem::command {
namespace {

using nlohmann::json;

std::string text_of(const json& object, const char* name) {
    return replace_control_characters(object.value(name, std::string()));
}

// "periodic, every 10 ms"
std::string executor_of(const json& component) {
    const auto period = component.find("period_ms");
    const bool has_period = period != component.end() && period->is_number();
    return text_of(component, "executor") +
           (has_period ? fmt::format(", every {} ms", period->get<double>()) : "");
}

std::string state_of(const json& component) {
    const std::string callback = text_of(component, "callback");
    return text_of(component, "state") + (callback.empty() ? "" : " (" + callback + ")");
}

} // namespace

// Prints all answers before it reports failures, so that a host that hangs does not hide the others.
int opros_list(const OprosClientOptions& options) {
    const auto hosts = find_opros_hosts(options);
    json out = json::array();
    Table table({"COMPONENT", "TYPE", "STATE", "EXECUTOR", "HOST", "APPLICATION"});
    for (const auto& host : hosts) {
        out.push_back(host.list.is_null()
                          ? json{{"pid", host.pid}, {"components", json::array()}, {"error", host.error}}
                          : host.list);
        if (host.list.is_null()) {
            table.add_row({"-", "-", "UNREACHABLE", "-", std::to_string(host.pid), "(" + host.error + ")"});
            continue;
        }
        for (const auto& component : host.list.value("components", json::array()))
            table.add_row({text_of(component, "name"), text_of(component, "type"), state_of(component),
                           executor_of(component), std::to_string(host.pid),
                           text_of(host.list, "application")});
    }
    if (options.json)
        print_json(out);
    else if (!table.empty())
        print_text(table.text());
    if (hosts.empty())
        throw std::runtime_error("no opros_host of this user is running on this machine; start one first");
    if (std::all_of(hosts.begin(), hosts.end(), [](const OprosHost& host) { return host.list.is_null(); }))
        throw std::runtime_error(hosts.front().error);
    return 0;
}

} // namespace tandem::command
