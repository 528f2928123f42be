// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <cstddef>
#include <vector>

namespace tandem::command {

/// A connection between two ports of hosts that no link carries.
struct InsideConnection {
    const monitor::HostState *from_host, *to_host;
    const monitor::HostPort *from, *to; ///< the port that sends or calls, and the one that receives or serves
};

/// The pointers are valid as long as the state.
struct InsideConnections {
    static constexpr std::size_t most = 10'000; ///< a host may list one id for all of its ports
    std::vector<InsideConnection> shown;
    std::size_t left_out = 0;
};

/// Returns the connections that the hosts list, sorted by name.
InsideConnections inside_connections(const monitor::State& state);

} // namespace tandem::command
