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

/// A blob that each side publishes in the segment, for messages that are too long for a ring.
struct LargeMessageLimits {
    std::uint64_t requested; ///< bytes that the user requested with `large_kib`; 0: the default
    std::uint64_t available; ///< size of its rings' chunks in bytes; max_large_bytes without rings
};

/// Names of a side's objects in the segment.
inline const std::string table_name = "table";
inline const std::string calls_name = "calls";
inline const std::string limits_name = "large";
inline const std::string ring_prefix = "port ";
inline std::string ring_name(const std::string& port) { return ring_prefix + port; }
/// Returns `port odometry`, or `port odometry#1` if the port's type has changed since the link came up.
inline std::string ring_name(const Port& port) {
    return ring_name(port.name) + (port.ring == 0 ? "" : "#" + std::to_string(port.ring));
}

/// One generation of the link's segment, from joining it until the peer or the segment is lost. Every thread that
/// works in the segment holds a shared_ptr to the session, so that the memory stays mapped until the last thread has
/// finished. SessionJoiner creates sessions; LinkState holds the current one.
class LinkSession {
  public:
    /// `incoming_calls` is this side's call queue in the segment, which the peer calls.
    LinkSession(std::shared_ptr<shm::Segment> segment, const shm::CallQueueHandle& incoming_calls,
                const shm::WaitOptions& wait);

    const std::shared_ptr<shm::Segment>& segment() const { return segment_; }
    shm::Side peer_side() const { return shm::other(segment_->side()); }

    /// Returns, in one line, why the session cannot continue, or an empty string. Makes a few system calls.
    /// [any-thread]
    std::string end_reason() const;

    /// Returns the peer's table, or nothing while the peer is changing it; the peer then notifies this side. Throws
    /// LinkError or shm::Error, one line, if the table is missing or damaged. [supervisor-thread]
    std::optional<PublishedTable> read_peer_table();
    /// Returns true if the peer has changed its table since read_peer_table() last returned one. [supervisor-thread]
    bool peer_table_changed() const;
    /// Replaces this side's table, and notifies the peer of the table and the added objects. Throws LinkError if the
    /// table does not fit. [supervisor-thread]
    void publish_table(const PortTable& table);
    /// Returns nothing if the peer has published no readable limits.
    std::optional<LargeMessageLimits> read_peer_limits() const;

    /// Opens the peer's call queue before the link is up. Throws LinkError if there is none. [supervisor-thread]
    void open_outgoing_calls();

    shm::CallServer& incoming_calls() { return incoming_calls_; }
    /// Returns nullptr before open_outgoing_calls().
    shm::CallClient* outgoing_calls() { return outgoing_calls_ ? &*outgoing_calls_ : nullptr; }
    /// Makes threads that wait in this session for calls or messages return. [any-thread]
    void interrupt();
    /// Ends all running calls with CallStatus::shut_down and refuses later ones. Makes all waits return permanently.
    /// [any-thread]
    void shut_down();

  private:
    std::shared_ptr<shm::Segment> segment_;
    shm::WaitOptions wait_;
    shm::CallServer incoming_calls_;
    std::optional<shm::CallClient> outgoing_calls_;
    std::uint64_t own_version_ = 1;         ///< of this side's published table
    std::span<const std::byte> peer_table_; ///< in the segment
    std::uint64_t peer_version_ = 0;
};

} // namespace tandem::link
