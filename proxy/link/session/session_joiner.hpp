// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/session/link_options.hpp"
#include "proxy/link/session/link_session.hpp"

#include <cstddef>
#include <memory>

namespace tandem::link {

/// Joins one generation of the link's segment after the other and publishes there what this side has: port
/// table, rings, call queue. Remembers what earlier peers asked for, so that the next segment has room for it.
/// [supervisor-thread], and the thread that opens the link before that one runs
class SessionJoiner {
  public:
    SessionJoiner(shm::Side side, const LinkOptions& options, const PortTable& own_ports);

    /// Throws shm::SideTaken if another holder of this side is alive, shm::Error if the segment cannot be
    /// joined or /dev/shm lacks the memory for it.
    std::shared_ptr<LinkSession> join() const;

    /// Adds the rings that the ports of the own table, which has changed, need in a session that join() has returned; not yet
    /// seen by the peer. A port whose ring finds no room is taken from the table, with one line. Throws shm::Error.
    void add_missing_rings(const LinkSession& session, PortTable& own_ports) const;

    /// True if the peer asks for longer messages than the chunks of this side's rings hold. The next join()
    /// then creates longer ones.
    bool peer_needs_larger_chunks(const LargeMessageLimits& peer);
    /// False while the peer's rings are too small for what this side's user asked for. The peer sees that,
    /// too, and joins a new segment.
    bool peer_chunks_suffice(const LargeMessageLimits& peer) const {
        return peer.available >= options_.rings.large_bytes;
    }
    /// Remembers how much memory the peer's chunks take, for when this side creates the next segment.
    void remember_peer_memory(const LinkSession& session);

  private:
    RingSizes sizes() const;

    const shm::Side side_;
    const LinkOptions& options_;
    const PortTable& own_ports_;
    std::size_t large_bytes_; ///< the largest that either side has asked for so far
    std::size_t peer_chunk_bytes_;
};

} // namespace tandem::link
