// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/published_table.hpp"
#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include "shm/segment.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace tandem::link {

/// What a side publishes about messages that are too long for a ring, as a blob in the segment.
struct LargeMessageLimits {
    std::uint64_t requested; ///< bytes that the user asked for with `large_kib`; 0: did not ask
    std::uint64_t available; ///< bytes of a chunk in its rings; max_large_bytes if it has created no rings
};

/// Names of a side's objects in the segment.
inline const std::string table_name = "table";
inline const std::string calls_name = "calls";
inline const std::string limits_name = "large";
inline const std::string ring_prefix = "port ";
inline std::string ring_name(const std::string& port) { return ring_prefix + port; }
/// `port odometry`; of a port that has got another type since the link is up `port odometry#1`.
inline std::string ring_name(const Port& port) {
    return ring_name(port.name) + (port.ring == 0 ? "" : "#" + std::to_string(port.ring));
}

/// One generation of the link's segment, from joining it until the peer or the segment is lost. Every thread
/// that works in the segment holds a shared_ptr to the session, so the memory stays mapped until the last of
/// them is done. SessionJoiner creates it; LinkState says which one is current.
class LinkSession {
  public:
    /// `incoming_calls` is this side's call queue in the segment, which the peer calls.
    LinkSession(std::shared_ptr<shm::Segment> segment, const shm::CallQueueHandle& incoming_calls,
                const shm::WaitOptions& wait);

    const std::shared_ptr<shm::Segment>& segment() const { return segment_; }
    shm::Side peer_side() const { return shm::other(segment_->side()); }

    /// Why the session cannot go on, one line; empty while it can. A few system calls. [any-thread]
    std::string end_reason() const;

    /// What the peer has published; nothing while it changes its table, after which it tells this side. Throws LinkError or
    /// shm::Error, one line, if it is missing or damaged. [supervisor-thread]
    std::optional<PublishedTable> read_peer_table();
    /// Whether it has changed its table since the last read_peer_table() that has returned one. [supervisor-thread]
    bool peer_table_changed() const;
    /// Replaces the own table, and tells the peer of it and of the objects that were added. Throws LinkError if it does not
    /// fit. [supervisor-thread]
    void publish_table(const PortTable& table);
    /// Nothing if the peer has published no limits that can be read.
    std::optional<LargeMessageLimits> read_peer_limits() const;

    /// Opens the peer's call queue, before the link is up. Throws LinkError if there is none. [supervisor-thread]
    void open_outgoing_calls();

    shm::CallServer& incoming_calls() { return incoming_calls_; }
    /// nullptr before open_outgoing_calls().
    shm::CallClient* outgoing_calls() { return outgoing_calls_ ? &*outgoing_calls_ : nullptr; }
    /// Makes threads that wait in this session for calls or messages return. [any-thread]
    void interrupt();
    /// The same for good: ends all calls under way with CallStatus::shut_down and refuses later ones. [any-thread]
    void shut_down();

  private:
    std::shared_ptr<shm::Segment> segment_;
    shm::WaitOptions wait_;
    shm::CallServer incoming_calls_;
    std::optional<shm::CallClient> outgoing_calls_;
    std::uint64_t own_version_ = 1;         ///< of the table that this side has published
    std::span<const std::byte> peer_table_; ///< in the segment
    std::uint64_t peer_version_ = 0;
};

} // namespace tandem::link
