// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/duplicate_connections.hpp"

#include <map>
#include <tuple>

namespace tandem::engine {
namespace {

/// Identifies a connection: type, source component and port, target component and port.
using ConnectionKey = std::tuple<PortType, std::string, std::string, std::string, std::string>;

ConnectionKey key_of(const ConnectionProfile& connection) {
    return {connection.type, connection.source.component, connection.source.port, connection.target.component,
            connection.target.port};
}

/// The positions of a connection in the resulting list.
struct Occurrences {
    std::size_t first;
    std::size_t second = 0; ///< valid if count > 1
    std::size_t count = 1;
};

/// Keeps the first of the connections with the same ports and error, and adds their number to its error.
std::vector<ConnectionProfile> merge_equal_errors(std::vector<ConnectionProfile> connections) {
    std::map<std::pair<ConnectionKey, std::string>, Occurrences> seen;
    std::vector<ConnectionProfile> kept;
    for (ConnectionProfile& connection : connections) {
        if (!connection.error.empty()) {
            const auto [entry, is_new] =
                seen.try_emplace({key_of(connection), connection.error}, Occurrences{kept.size(), 0, 0});
            if (++entry->second.count > 1) continue;
        }
        kept.push_back(std::move(connection));
    }
    for (const auto& [key, occurrences] : seen)
        if (occurrences.count > 1)
            kept[occurrences.first].error +=
                ", in a connection that is listed " + std::to_string(occurrences.count) + " times";
    return kept;
}

std::string second_provider_error(const ConnectionProfile& first, const PortReference& required) {
    return "required port " + required.text() + " is connected to " + first.target.text() + " already, " +
           first.location.text() + "; expected one provider of a required port: remove one of the two";
}

std::string duplicate_error(const ConnectionProfile& first, std::size_t count) {
    return "connection " + first.source.text() + " -> " + first.target.text() + " is listed " +
           std::to_string(count) + " times, first at " + first.location.text() +
           "; expected it once: remove the others";
}

/// Processes the list once, in order.
class DuplicateFinder {
  public:
    void add(ConnectionProfile&& connection) {
        if (connection.error.empty() && !count(connection)) return;
        kept_.push_back(std::move(connection));
    }

    std::vector<ConnectionProfile> take_result() && {
        for (const auto& [key, occurrences] : seen_)
            if (occurrences.count > 1)
                kept_[occurrences.second].error =
                    duplicate_error(kept_[occurrences.first], occurrences.count);
        return std::move(kept_);
    }

  private:
    /// Returns false if the connection occurs for the third time or later and must be dropped.
    bool count(ConnectionProfile& connection) {
        const auto [entry, is_new] = seen_.try_emplace(key_of(connection), Occurrences{kept_.size()});
        if (!is_new) {
            if (++entry->second.count > 2) return false;
            entry->second.second = kept_.size();
        } else if (connection.type == OPROS_SERVICE) {
            check_provider(connection);
        }
        return true;
    }

    void check_provider(ConnectionProfile& connection) {
        const auto [first, is_first] =
            providers_.try_emplace({connection.source.component, connection.source.port}, kept_.size());
        if (!is_first) connection.error = second_provider_error(kept_[first->second], connection.source);
    }

    std::vector<ConnectionProfile> kept_;
    std::map<ConnectionKey, Occurrences> seen_;
    /// Component and name of the required port -> index of its first connection in kept_.
    std::map<std::pair<std::string, std::string>, std::size_t> providers_;
};

} // namespace

void mark_duplicate_connections(std::vector<ConnectionProfile>& connections) {
    DuplicateFinder finder;
    for (ConnectionProfile& connection : merge_equal_errors(std::move(connections)))
        finder.add(std::move(connection));
    connections = std::move(finder).take_result();
}

} // namespace tandem::engine
