// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/link/protocol/request.hpp"

#include <optional>
#include <string>

namespace tandem::link {

/// Implemented by the owner of a Link: reacts when the peer connects, disconnects and calls. Each function names the thread
/// that calls it; the README of this folder lists the threads.
class LinkHandler {
  public:
    virtual ~LinkHandler() = default;

    /// Compares the peer's ports with the needs of this side, and removes unusable ports from the table. Returns an empty
    /// string to accept the rest, otherwise one line that names the port and what was expected. [supervisor-thread] Must
    /// not wait for the peer.
    virtual std::string check_peer_ports(PortTable& peer) = 0;

    /// Called when data start to flow (`up`), or stop. [supervisor-thread] Must not wait for the peer: while this function
    /// runs, no thread watches whether the peer is alive.
    virtual void link_state_changed(bool up) = 0;

    /// Called when the sender of a port has been silent for longer than the port's deadline. [supervisor-thread] Must not
    /// wait for the peer.
    virtual void deadline_missed(const std::string& port) = 0;

    /// Called after link_state_changed(true) and link_state_changed(false). [task-thread] May call the peer.
    virtual void peer_connected() = 0;
    virtual void peer_disconnected() = 0;

    /// Called when the peer's ports have changed while the link is up, after check_peer_ports() has accepted the new table.
    /// [task-thread] May call the peer.
    virtual void peer_ports_changed() {}

    /// Executes one call of the peer. [worker-thread] Runs in several threads at once; may call the peer in turn.
    virtual Reply serve(const Request&) = 0;
    /// Executes a call by its ids; called before serve(). The reply is in `memory`, or empty. Returns nothing if serve()
    /// must find the operation by its names. [worker-thread]
    virtual std::optional<ReplyView> serve_known(const KnownRequest&, wire::MessageBuffer& memory) {
        static_cast<void>(memory);
        return std::nullopt;
    }
};

} // namespace tandem::link
