// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "apps/tandem/rtm/running/component_source.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <fmt/format.h>

namespace tandem::command {

// Prints all answers before it reports failures, so that a dead name server does not hide the components of others.
int rtm_list(const RtmClientOptions& options) {
    const RtmClient client(options);
    const auto sources = enumerate_components(client);
    nlohmann::json json = nlohmann::json::array();
    Table table({"INSTANCE", "TYPE", "STATE", ">PORTS", "ADDRESS"});
    for (const auto& source : sources) {
        // A manager's component that is also bound in a name server has two lines, one for each address.
        for (const auto& entry : source.components) {
            json.push_back({{"instance", entry.instance},
                            {"type", entry.type},
                            {"category", entry.category},
                            {"state", entry.error.empty() ? entry.state : "UNREACHABLE"},
                            {"callback", entry.callback},
                            {"ports", entry.ports},
                            {"address", entry.address},
                            {"error", entry.error}});
            if (entry.error.empty())
                table.add_row({entry.instance, entry.type, entry.describe_state(),
                               std::to_string(entry.ports), entry.address});
            else
                table.add_row({"-", "-", "UNREACHABLE", "-", entry.address + " (" + entry.error + ")"});
        }
    }
    if (options.json)
        print_json(json);
    else if (!table.empty())
        print_text(table.text());
    throw_if_sources_failed(client, sources);
    return 0;
}

} // namespace tandem::command
