// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <vector>

namespace tandem::command {

/// A connection between two ports of hosts that no link carries.
struct InsideConnection {
    const monitor::HostState *from_host, *to_host;
    const monitor::HostPort *from, *to; ///< the port that sends or calls, and the one that receives or serves
};

/// Returns the connections that the hosts list. The pointers are valid as long as the state.
std::vector<InsideConnection> inside_connections(const monitor::State& state);

} // namespace tandem::command
