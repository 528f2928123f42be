// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/places.hpp"

namespace tandem::monitor {

std::optional<Place> Places::take(const std::string& peer, bool has_token) {
    if (all_ < max_open && !is_peer_full(peer)) {
        ++all_;
        ++open_[peer];
        return Place(*this, peer, false);
    }
    if (!has_token || reserved_taken_ >= reserved) return std::nullopt;
    ++reserved_taken_;
    return Place(*this, peer, true);
}

bool Places::is_peer_full(const std::string& peer) const {
    const auto found = open_.find(peer);
    return found != open_.end() && found->second >= max_of_a_peer;
}

void Places::leave(const std::string& peer, bool is_reserved) {
    if (is_reserved) {
        --reserved_taken_;
        return;
    }
    --all_;
    const auto found = open_.find(peer);
    if (--found->second == 0) open_.erase(found);
}

} // namespace tandem::monitor
