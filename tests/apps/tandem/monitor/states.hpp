// SPDX-License-Identifier: Apache-2.0
// States as the monitor's reader makes them.
#pragma once
#include "apps/tandem/monitor/state.hpp"

namespace tandem::monitor::test {

inline PortState port(const std::string& name) {
    PortState port;
    port.name = name;
    port.owner = shm::Side::second;
    port.writer = shm::Side::first;
    return port;
}

inline CallQueueState calls() {
    CallQueueState queue;
    queue.name = "calls";
    queue.callers = shm::Side::second;
    return queue;
}

/// A link with both hosts, a port and a call queue, with which nothing is wrong.
inline LinkState sound_link(const std::string& name = "chair") {
    LinkState link;
    link.name = name;
    link.generation = 1;
    link.created_ns = 1000;
    link.sides[0] = {shm::PeerState::alive, 11, "opros_host", false, "OPRoS"};
    link.sides[1] = {shm::PeerState::alive, 22, "rtm_host", false, "RTM"};
    link.ports = {port("velocity")};
    link.call_queues = {calls()};
    return link;
}

inline State state_of(std::vector<LinkState> links) {
    State state;
    state.time_ms = 1;
    state.links = std::move(links);
    return state;
}

} // namespace tandem::monitor::test
