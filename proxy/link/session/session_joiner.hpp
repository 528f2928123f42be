// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/session/link_options.hpp"
#include "proxy/link/session/link_session.hpp"

#include <cstddef>
#include <memory>
#include <string>

namespace tandem::link {

/// Joins one generation of the link's segment after the other, and publishes this side's port table, rings and call
/// queue there. Remembers the requests of earlier peers, so that the next segment has room for them.
/// [supervisor-thread; before that thread runs: the thread that opens the link]
class SessionJoiner {
  public:
    SessionJoiner(shm::Side side, const LinkOptions& options, const PortTable& own_ports);

    /// Throws shm::SideTaken if another holder of this side is alive, shm::Error if the segment cannot be joined or
    /// /dev/shm lacks memory.
    std::shared_ptr<LinkSession> join() const;

    /// Adds the rings that this side's changed table needs to a session from join(). The peer does not see them yet.
    /// Removes the ports whose rings find no room from `session_ports`, and those that no later session can have either
    /// from `own_ports`. Returns a line about them with the remedy; empty if there are none. Throws shm::Error.
    std::string add_missing_rings(const LinkSession& session, PortTable& session_ports,
                                  PortTable& own_ports) const;

    /// Returns true if the peer requests longer messages than the chunks of this side's rings hold. The next join()
    /// then creates longer chunks.
    bool peer_needs_larger_chunks(const LargeMessageLimits& peer);
    /// Returns false while the peer's rings are too small for this side's request. The peer detects this as well and
    /// joins a new segment.
    bool peer_chunks_suffice(const LargeMessageLimits& peer) const;
    /// Remembers the memory of the peer's chunks, in case this side creates the next segment.
    void remember_peer_memory(const LinkSession& session);

  private:
    RingSizes sizes() const;
    std::string remedy(const shm::Error& error) const;

    const shm::Side side_;
    const LinkOptions& options_;
    const PortTable& own_ports_;
    std::size_t large_bytes_; ///< the larger request of the two sides so far; 0: the default
    std::size_t peer_chunk_bytes_;
};

} // namespace tandem::link
