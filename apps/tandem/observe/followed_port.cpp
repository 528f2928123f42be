// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/observe/followed_port.hpp"

#include "proxy/link/protocol/link_error.hpp"
#include "proxy/link/session/link_session.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/time.hpp"

#include <cstring>

namespace tandem::command {
namespace {

/// Calls `look` with each side's port table. Skips damaged tables, and tables that their owner is changing.
template <class Look>
void for_each_table(const shm::Observation& observation, Look look) {
    for (const auto& blob : observation.blobs) {
        if (!blob.damage.empty() || blob.name != link::table_name) continue;
        try {
            if (auto published = link::read_published_table(blob.content))
                look(blob.owner, std::move(published->table));
        } catch (const link::LinkError&) { // no table: the other side's table is still used
        } catch (const wire::SignatureError&) {
        }
    }
}

void add_ports(shm::Side owner, link::PortTable&& table, std::vector<FollowedPort>& ports) {
    for (link::Port& port : table.ports) {
        if (!port.has_ring()) continue;
        FollowedPort followed;
        followed.owner = owner;
        followed.writer = port.kind == link::PortKind::data_out ? owner : shm::other(owner);
        followed.message = wire::parse_signature(port.signature);
        followed.timed = wire::is_timed(followed.message);
        followed.port = std::move(port);
        ports.push_back(std::move(followed));
    }
}

} // namespace

void append_message(const FollowedPort& port, std::span<const std::byte> bytes, std::uint64_t stamp,
                    std::vector<std::byte>& out) {
    if (port.timed) {
        const std::uint32_t time[2] = {wire::stamp_seconds(stamp), wire::stamp_nanoseconds(stamp)};
        const auto* const begin = reinterpret_cast<const std::byte*>(time);
        out.insert(out.end(), begin, begin + sizeof time);
    }
    out.insert(out.end(), bytes.begin(), bytes.end());
}

std::vector<FollowedPort> find_ports(const shm::Observation& observation) {
    std::vector<FollowedPort> ports;
    for_each_table(observation, [&](shm::Side owner, link::PortTable table) {
        add_ports(owner, std::move(table), ports);
    });
    return ports;
}

PortNames find_port_names(const shm::Observation& observation) {
    PortNames found;
    for_each_table(observation, [&](shm::Side, const link::PortTable& table) {
        ++found.tables;
        for (const link::Port& port : table.ports) found.names.insert(port.name);
    });
    return found;
}

Models find_models(const shm::Observation& observation, Models known) {
    for_each_table(observation, [&](shm::Side owner, link::PortTable table) {
        known[shm::index_of(owner)] = std::move(table.model);
    });
    return known;
}

} // namespace tandem::command
