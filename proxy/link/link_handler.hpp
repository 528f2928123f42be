// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/link/protocol/request.hpp"

#include <optional>
#include <string>

namespace tandem::link {

/// What the owner of a Link does when the peer connects, disconnects and calls. Each function names the
/// thread that calls it; see the README of this folder for the threads.
class LinkHandler {
  public:
    virtual ~LinkHandler() = default;

    /// Compares the peer's ports with what this side needs, and removes from the table those that it cannot use.
    /// Returns an empty string to accept the others, otherwise one line that names the port and what was expected.
    /// [supervisor-thread] Must not wait for the peer.
    virtual std::string check_peer_ports(PortTable& peer) = 0;

    /// Data flow from now on (`up`), or no longer. [supervisor-thread] Must not wait for the peer: while this
    /// function runs, nobody watches whether it is alive.
    virtual void link_state_changed(bool up) = 0;

    /// The sender of a port has been silent for longer than the port's deadline. [supervisor-thread] Must not wait for the
    /// peer.
    virtual void deadline_missed(const std::string& port) = 0;

    /// Follow link_state_changed(true) and link_state_changed(false). [task-thread] May call the peer.
    virtual void peer_connected() = 0;
    virtual void peer_disconnected() = 0;

    /// The peer's ports have changed while the link is up, and check_peer_ports() has accepted the new table.
    /// [task-thread] May call the peer.
    virtual void peer_ports_changed() {}

    /// Executes one call of the peer. [worker-thread] Several at once; may call the peer in turn.
    virtual Reply serve(const Request&) = 0;
    /// The same by ids, asked first; the reply is in `memory`, or nowhere. Nothing: serve() has to find it by its names.
    /// [worker-thread]
    virtual std::optional<ReplyView> serve_known(const KnownRequest&, wire::MessageBuffer& memory) {
        static_cast<void>(memory);
        return std::nullopt;
    }
};

} // namespace tandem::link
