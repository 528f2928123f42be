// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/session/session_joiner.hpp"

#include "proxy/link/protocol/call_limits.hpp"
#include "proxy/link/session/ring_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace tandem::link {
namespace {

// Version of everything, except the segment's layout, that both sides must agree on. Raise it when the port table, the
// requests or the records change. A segment with another version is refused.
constexpr std::uint64_t protocol_version = 0x7461'6e64'656d'0009; // "tandem", 9

shm::CallQueueOptions call_queue(shm::Side callers) { return {callers, max_calls, max_call_bytes}; }

std::size_t call_queue_bytes() {
    return object_bytes(shm::call_queue_memory(calls_name, call_queue(shm::Side::first)).total);
}

/// Returns the longest message of a side with this RingSizes::large_bytes.
std::size_t longest_message(std::size_t large_bytes) {
    return large_bytes != 0 ? large_bytes : default_large_bytes;
}

} // namespace

SessionJoiner::SessionJoiner(shm::Side side, const LinkOptions& options, const PortTable& own_ports)
    : side_(side), options_(options), own_ports_(own_ports), large_bytes_(options.rings.large_bytes),
      peer_chunk_bytes_(call_queue_bytes() + room_for_late_ports(options.rings)) {}

RingSizes SessionJoiner::sizes() const {
    RingSizes sizes = options_.rings;
    sizes.large_bytes = large_bytes_;
    return sizes;
}

std::shared_ptr<LinkSession> SessionJoiner::join() const {
    const RingPlan plan = plan_rings(own_ports_, side_, sizes());
    check_available_memory(plan, sizes());

    const bool may_change = !own_ports_.components.empty();
    const auto table = encode(own_ports_);
    const std::size_t needed = plan.object_bytes +
                               object_bytes(published_table_bytes(table.size(), may_change)) +
                               object_bytes(sizeof(LargeMessageLimits));

    shm::JoinOptions join_options;
    join_options.arena_bytes = options_.segment_bytes;
    // An RTC with many ports needs more than segment_bytes, but this does not enlarge the peer's arena.
    join_options.chunk_pool_bytes =
        call_queue_bytes() + plan.chunk_bytes + needed - std::min(needed, options_.segment_bytes);
    if (may_change) join_options.chunk_pool_bytes += room_for_late_ports(sizes());
    join_options.peer_chunk_pool_bytes = peer_chunk_bytes_;
    // Most ports with potentially long messages never send one. Their chunks take no memory until they are used.
    join_options.sparse = true;
    join_options.contract = protocol_version;
    join_options.group = options_.group;
    std::shared_ptr<shm::Segment> segment = shm::Segment::join(options_.name, side_, join_options);

    for (const auto& ring : plan.rings) segment->add_ring(ring_name(*ring.port), ring.options);
    const auto incoming_calls = segment->add_call_queue(calls_name, call_queue(shm::other(side_)));
    write_published_table(segment->add_blob(table_name, published_table_bytes(table.size(), may_change)),
                          table, 1);
    const LargeMessageLimits limits{options_.rings.large_bytes,
                                    plan.rings.empty() ? max_large_bytes : longest_message(large_bytes_)};
    std::memcpy(segment->add_blob(limits_name, sizeof limits).data(), &limits, sizeof limits);
    segment->publish(); // last, because the peer reads everything as soon as it sees this
    return std::make_shared<LinkSession>(segment, incoming_calls, options_.wait);
}

std::string SessionJoiner::add_missing_rings(const LinkSession& session, PortTable& session_ports,
                                             PortTable& own_ports) const {
    auto& segment = *session.segment();
    const PortTable wanted = session_ports;
    std::vector<std::string> without_room;
    std::string cause; // of the first one
    for (const auto& ring : plan_rings(wanted, side_, sizes()).rings) {
        // A port that was added again still has its ring.
        if (segment.find_ring(side_, ring_name(*ring.port))) continue;
        try {
            segment.add_ring(ring_name(*ring.port), ring.options);
        } catch (const shm::Error& error) {
            std::erase(session_ports.ports, *ring.port);
            if (!dynamic_cast<const shm::ArenaFull*>(&error)) std::erase(own_ports.ports, *ring.port);
            if (without_room.empty()) cause = remedy(error);
            without_room.push_back(ring.port->name);
        }
    }
    if (without_room.empty()) return "";
    return fmt::format(
        "port '{}'{} was added after the link was set up and is not shared: {}", without_room.front(),
        without_room.size() == 1 ? "" : fmt::format(" (and {} others)", without_room.size() - 1), cause);
}

std::string SessionJoiner::remedy(const shm::Error& error) const {
    const auto* full = dynamic_cast<const shm::ArenaFull*>(&error);
    if (!full) return error.what();
    constexpr std::size_t mib = std::size_t{1024} * 1024;
    return fmt::format("it needs {} bytes of shared memory, {} are left; add {} to this side's `segment_mib` "
                       "(now {}) for each such port, or restart the other host",
                       full->needed, full->left, (full->needed + mib - 1) / mib,
                       options_.segment_bytes / mib);
}

bool SessionJoiner::peer_needs_larger_chunks(const LargeMessageLimits& peer) {
    // The segment's content may be damaged, so a request above the maximum is ignored.
    if (peer.requested > max_large_bytes || longest_message(peer.requested) <= longest_message(large_bytes_))
        return false;
    large_bytes_ = peer.requested;
    // A side without data ports creates no rings, so there is nothing to enlarge.
    return std::any_of(own_ports_.ports.begin(), own_ports_.ports.end(),
                       [](const Port& port) { return port.has_ring(); });
}

bool SessionJoiner::peer_chunks_suffice(const LargeMessageLimits& peer) const {
    return peer.available >= longest_message(options_.rings.large_bytes);
}

void SessionJoiner::remember_peer_memory(const LinkSession& session) {
    const std::size_t arena = session.segment()->arena_bytes(session.peer_side());
    peer_chunk_bytes_ = arena - std::min(arena, options_.segment_bytes);
}

} // namespace tandem::link
