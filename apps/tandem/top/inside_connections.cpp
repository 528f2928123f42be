// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/top/inside_connections.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace tandem::command {

InsideConnections inside_connections(const monitor::State& state) {
    using End = std::pair<const monitor::HostState*, const monitor::HostPort*>;
    std::map<std::string, std::pair<std::vector<End>, std::vector<End>>> ends; // by id: sources and targets
    for (const auto& host : state.hosts) {
        if (!host.inventory) continue;
        for (const auto& port : host.inventory->ports)
            for (const auto& id : port.connections) {
                auto& [sources, targets] = ends[id];
                const bool is_source = port.direction == "output" || port.direction == "required";
                (is_source ? sources : targets).emplace_back(&host, &port);
            }
    }
    InsideConnections connections;
    auto& shown = connections.shown;
    for (const auto& [id, both] : ends) {
        const auto& [sources, targets] = both;
        const std::size_t all = sources.size() * targets.size(),
                          count = std::min(all, InsideConnections::most - shown.size());
        connections.left_out += all - count;
        for (std::size_t i = 0; i < count; ++i) {
            const auto& [from_host, from] = sources[i / targets.size()];
            const auto& [to_host, to] = targets[i % targets.size()];
            shown.push_back({from_host, to_host, from, to});
        }
    }
    const auto names = [](const InsideConnection& each) {
        return std::tie(each.from->component, each.from->name, each.to->component, each.to->name);
    };
    std::stable_sort(shown.begin(), shown.end(),
                     [&](const auto& a, const auto& b) { return names(a) < names(b); });
    return connections;
}

} // namespace tandem::command
