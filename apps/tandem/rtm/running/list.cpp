// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "apps/tandem/rtm/running/component_source.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace tandem::command {

namespace {

/// A component with its addresses in name servers and managers.
struct ListedComponent {
    const ComponentEntry* entry;
    nlohmann::json addresses;
};

// A component that does not answer cannot be compared. It is listed with each address.
std::vector<ListedComponent> distinct_components(const std::vector<ComponentSource>& sources) {
    std::vector<ListedComponent> listed;
    for (const auto& source : sources)
        for (const auto& entry : source.components) {
            const auto same = std::find_if(listed.begin(), listed.end(), [&](const ListedComponent& other) {
                return !CORBA::is_nil(entry.object.in()) && !CORBA::is_nil(other.entry->object.in()) &&
                       entry.object->_is_equivalent(other.entry->object.in());
            });
            if (same == listed.end())
                listed.push_back({&entry, nlohmann::json::array({entry.address})});
            else
                same->addresses.push_back(entry.address);
        }
    return listed;
}

} // namespace

// Prints all answers before it reports failures, so that a dead name server does not hide the components of others.
int rtm_list(const RtmClientOptions& options) {
    const RtmClient client(options);
    const auto sources = enumerate_components(client);
    nlohmann::json json = nlohmann::json::array();
    Table table({"INSTANCE", "TYPE", "STATE", ">PORTS", "ADDRESS"});
    for (const auto& [listed, addresses] : distinct_components(sources)) {
        const ComponentEntry& entry = *listed;
        json.push_back({{"instance", entry.instance},
                        {"type", entry.type},
                        {"category", entry.category},
                        {"state", entry.error.empty() ? entry.state : "UNREACHABLE"},
                        {"callback", entry.callback},
                        {"ports", entry.ports},
                        {"address", entry.address},
                        {"addresses", addresses},
                        {"error", entry.error}});
        if (entry.error.empty())
            table.add_row({entry.instance, entry.type, entry.describe_state(), std::to_string(entry.ports),
                           entry.address});
        else
            table.add_row({"-", "-", "UNREACHABLE", "-", entry.address + " (" + entry.error + ")"});
    }
    if (options.json)
        print_json(json);
    else if (!table.empty())
        print_text(table.text());
    throw_if_sources_failed(client, sources);
    return 0;
}

} // namespace tandem::command
