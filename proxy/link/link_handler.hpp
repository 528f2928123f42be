// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/link/protocol/request.hpp"

#include <optional>
#include <string>

namespace tandem::link {

/// Implemented by the owner of a Link: reacts when the peer connects, disconnects and calls. Each function names its
/// calling thread; the README of this folder lists the threads.
class LinkHandler {
  public:
    virtual ~LinkHandler() = default;

    /// Compares the peer's ports with the needs of this side, and removes unusable ports from the table. Returns an
    /// empty string to accept the rest, otherwise one line with the port and what was expected. Must not wait for the
    /// peer. [supervisor-thread]
    virtual std::string check_peer_ports(PortTable& peer) = 0;

    /// Is called when data starts (`up`) or stops flowing. Must not wait for the peer: while this function runs, no
    /// thread watches whether the peer is alive. [supervisor-thread]
    virtual void link_state_changed(bool up) = 0;

    /// Is called when the sender of a port has been silent for longer than the port's deadline. Must not wait for the
    /// peer. [supervisor-thread]
    virtual void deadline_missed(const std::string& port) = 0;

    /// Are called after link_state_changed(true) and link_state_changed(false). May call the peer. [task-thread]
    virtual void peer_connected() = 0;
    virtual void peer_disconnected() = 0;

    /// Is called when the peer's ports have changed while the link is up, after check_peer_ports() has accepted the
    /// new table. May call the peer. [task-thread]
    virtual void peer_ports_changed() {}

    /// Executes one call of the peer. Runs in several threads at once. May call the peer in turn. [worker-thread]
    virtual Reply serve(const Request&) = 0;
    /// Executes a call by its ids. Called before serve(). The reply is in `memory`, or empty. Returns nothing if
    /// serve() must find the operation by its names. [worker-thread]
    virtual std::optional<ReplyView> serve_known(const KnownRequest&, wire::MessageBuffer& memory) {
        static_cast<void>(memory);
        return std::nullopt;
    }
};

} // namespace tandem::link
