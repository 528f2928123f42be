// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/running.hpp"
#include "apps/tandem/rtm/running/survey.hpp"
#include "apps/tandem/text.hpp"

#include <fmt/format.h>

namespace tandem::command {

int rtm_list(const PeerOptions& options) {
    const Peers peers(options);
    const auto places = survey(peers);
    nlohmann::json json = nlohmann::json::array();
    Table table({"INSTANCE", "TYPE", "STATE", ">PORTS", "ADDRESS"});
    for (const auto& place : places) {
        for (const auto& seen : place.components) {
            json.push_back({{"instance", seen.instance},
                            {"type", seen.type},
                            {"category", seen.category},
                            {"state", seen.trouble.empty() ? seen.state : "UNREACHABLE"},
                            {"ports", seen.ports},
                            {"address", seen.address},
                            {"trouble", seen.trouble}});
            if (seen.trouble.empty())
                table.add({seen.instance, seen.type, seen.state, std::to_string(seen.ports), seen.address});
            else
                table.add({"-", "-", "UNREACHABLE", "-", seen.address + " (" + seen.trouble + ")"});
        }
    }
    if (options.json)
        print_json(json);
    else if (!table.empty())
        print_text(table.text());
    require_answers(peers, places);
    return 0;
}

} // namespace tandem::command
