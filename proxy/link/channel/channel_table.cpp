// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/channel/channel_table.hpp"

#include "host/log/log.hpp"
#include "proxy/link/protocol/link_error.hpp"
#include "proxy/link/session/link_session.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::link {

ChannelWriter& ChannelTable::writer(const Port& port) {
    const std::lock_guard lock(mutex_);
    return writer_of({port.name, types_.number(port)});
}

ChannelReader& ChannelTable::reader(const Port& port) {
    const std::lock_guard lock(mutex_);
    return reader_of({port.name, types_.number(port)});
}

ChannelWriter& ChannelTable::writer(const std::string& port) {
    const std::lock_guard lock(mutex_);
    return writer_of({port, 0});
}

ChannelReader& ChannelTable::reader(const std::string& port) {
    const std::lock_guard lock(mutex_);
    return reader_of({port, 0});
}

// The functions below require mutex_.

ChannelWriter& ChannelTable::writer_of(const Key& key) {
    return writers_.try_emplace(key, key.first, wake_supervisor_).first->second;
}

ChannelReader& ChannelTable::reader_of(const Key& key) {
    return readers_.try_emplace(key, wake_supervisor_).first->second;
}

void ChannelTable::bind(const std::shared_ptr<shm::Segment>& segment, const PortTable& ports,
                        shm::Side owner) {
    const bool own_ports = owner == segment->side();
    const std::lock_guard lock(mutex_);
    for (const Port& port : ports.ports) {
        if (!port.has_ring()) continue;
        const Key key{port.name, types_.number(port)};
        // This side writes its own out ports and the peer's in ports.
        const bool writes = (port.kind == PortKind::data_out) == own_ports;
        if (writes ? writer_of(key).is_bound() : reader_of(key).is_bound()) continue;
        const auto ring = segment->find_ring(owner, ring_name(port));
        if (!ring) throw LinkError(fmt::format("port '{}' is in the port table but has no ring", port.name));
        if (writes) {
            writer_of(key).set_peer_listens(listened_ports_.contains(port.name));
            writer_of(key).bind(segment, shm::RingWriter(*ring));
        } else {
            reader_of(key).bind(segment, shm::RingReader(*ring));
        }
    }
}

std::uint64_t ChannelTable::unbind_all() {
    const std::lock_guard lock(mutex_);
    std::uint64_t unread = 0;
    for (auto& [key, writer] : writers_) unread += writer.unbind();
    for (auto& [key, reader] : readers_) unread += reader.unbind();
    listened_ports_.clear(); // the next peer must ask again
    return unread;
}

void ChannelTable::set_listened_ports(const std::vector<std::string>& ports) {
    const std::lock_guard lock(mutex_);
    listened_ports_ = {ports.begin(), ports.end()};
    for (auto& [key, writer] : writers_) writer.set_peer_listens(listened_ports_.contains(key.first));
}

std::chrono::nanoseconds ChannelTable::check_deadlines(std::vector<std::string>& missed) {
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    std::chrono::nanoseconds next_check = shm::longest_wait;
    for (auto& [key, reader] : readers_) {
        if (!reader.has_deadline()) continue;
        const std::string& name = key.first;
        if (reader.has_missed_deadline(now)) {
            missed.push_back(name);
            log::warn("port '{}': no message for {} ms, its deadline ({} so far)", name,
                      reader.deadline().count(), reader.missed_deadlines());
        }
        next_check = std::min(next_check, reader.deadline_check_in());
    }
    return next_check;
}

/// Checks the channels only if one has called since the last time: locking them costs their users a memory barrier.
bool ChannelTable::has_corrupt_ring() {
    if (!channel_has_called_.exchange(false)) return false;
    const std::lock_guard lock(mutex_);
    const auto corrupt = [](const auto& channel) { return channel.second.corrupt(); };
    return std::any_of(writers_.begin(), writers_.end(), corrupt) ||
           std::any_of(readers_.begin(), readers_.end(), corrupt);
}

} // namespace tandem::link
