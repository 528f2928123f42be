// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/duplicate_connections.hpp"

#include <map>
#include <tuple>

namespace tandem::engine {
namespace {

using Ports = std::tuple<PortType, std::string, std::string, std::string, std::string>;

Ports ports(const ConnectionProfile& connection) {
    return {connection.type, connection.source.component, connection.source.port, connection.target.component,
            connection.target.port};
}

struct Seen {
    std::size_t first, second = 0; ///< in the list that is kept; second: 0 until there is one
    std::size_t times = 1;
};

/// Takes what is wrong in the same way again off the list: the first of them tells how many.
std::vector<ConnectionProfile> wrong_once(std::vector<ConnectionProfile> connections) {
    std::map<std::pair<Ports, std::string>, Seen> seen;
    std::vector<ConnectionProfile> kept;
    for (ConnectionProfile& connection : connections) {
        if (!connection.error.empty()) {
            const auto [entry, is_new] =
                seen.try_emplace({ports(connection), connection.error}, Seen{kept.size(), 0, 0});
            if (++entry->second.times > 1) continue;
        }
        kept.push_back(std::move(connection));
    }
    for (const auto& [key, each] : seen)
        if (each.times > 1)
            kept[each.first].error +=
                ", in a connection that is listed " + std::to_string(each.times) + " times";
    return kept;
}

} // namespace

void mark_duplicate_connections(std::vector<ConnectionProfile>& connections) {
    std::map<Ports, Seen> seen;
    std::map<std::pair<std::string, std::string>, std::size_t> providers; // of required ports
    std::vector<ConnectionProfile> kept;
    connections = wrong_once(std::move(connections));
    for (ConnectionProfile& connection : connections) {
        if (connection.error.empty()) {
            const auto [entry, is_new] = seen.try_emplace(ports(connection), Seen{kept.size()});
            if (!is_new && ++entry->second.times > 2) continue;
            if (!is_new) entry->second.second = kept.size();
            if (is_new && connection.type == OPROS_SERVICE) {
                const auto [provider, is_first] =
                    providers.try_emplace({connection.source.component, connection.source.port}, kept.size());
                if (!is_first)
                    connection.error = "required port " + connection.source.text() + " is connected to " +
                                       kept[provider->second].target.text() + " already, " +
                                       kept[provider->second].location.text() +
                                       "; expected one provider of a required port, take one of the two away";
            }
        }
        kept.push_back(std::move(connection));
    }
    for (const auto& [key, each] : seen)
        if (each.times > 1)
            kept[each.second].error =
                "connection " + kept[each.second].source.text() + " -> " + kept[each.second].target.text() +
                " is listed " + std::to_string(each.times) + " times, first at " +
                kept[each.first].location.text() + "; expected it once, take the others away";
    connections = std::move(kept);
}

} // namespace tandem::engine
