// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/running/running_commands.hpp"
#include "apps/tandem/output/print.hpp"

#include <fmt/format.h>

namespace tandem::command {

int opros_transition(const OprosClientOptions& options, const std::vector<std::string>& names,
                     const std::string& command) {
    nlohmann::json out = nlohmann::json::array();
    for (const auto& name : names) {
        // Searched one by one, so components before a missing name are already changed.
        const RunningComponent component = find_running_component(options, name);
        const auto reply = request_component(options, component, command);
        const std::string state = reply.value("state", "");
        out.push_back({{"component", component.name}, {"pid", component.host.pid}, {"state", state}});
        if (!options.json) print_text(component.name + " " + state + "\n");
    }
    if (options.json) print_json(out);
    return 0;
}

} // namespace tandem::command
