// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/request_pool.hpp"

#include <algorithm>

namespace tandem::monitor {

void RequestPool::add(PooledConnection& connection) {
    if (count_of(connection.peer_key()) >= max_of_a_peer)
        free_place_of(connection.peer_key(), true);
    else if (open_.size() >= max_open) {
        const auto largest = std::max_element(open_.begin(), open_.end(), [&](const auto* a, const auto* b) {
            return count_of(a->peer_key()) < count_of(b->peer_key());
        });
        free_place_of((*largest)->peer_key(), false);
    }
    open_.push_back(&connection);
}

void RequestPool::renew(PooledConnection& connection) {
    const auto found = std::find(open_.begin(), open_.end(), &connection);
    if (found != open_.end()) open_.splice(open_.end(), open_, found);
}

std::size_t RequestPool::count_of(const std::string& peer) const {
    return static_cast<std::size_t>(std::count_if(
        open_.begin(), open_.end(), [&](const auto* connection) { return connection->peer_key() == peer; }));
}

/// Ends the peer's oldest connection that waits for a request, or else its oldest one.
void RequestPool::free_place_of(const std::string& peer, bool of_peer) {
    PooledConnection* oldest = nullptr;
    for (PooledConnection* connection : open_) {
        if (connection->peer_key() != peer) continue;
        if (oldest == nullptr || (!oldest->waits_for_request() && connection->waits_for_request()))
            oldest = connection;
    }
    if (oldest == nullptr) return;
    open_.remove(oldest);
    oldest->give_way(of_peer);
}

} // namespace tandem::monitor
