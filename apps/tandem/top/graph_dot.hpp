// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <string>

namespace tandem::command {

/// Returns a graph in Graphviz's language (graphviz.org/doc/info/lang.html): a box for each host with its components
/// and links, and an arrow for each port. Red: cannot be connected, or damaged. Grey: no message for 2 s. Dashed:
/// services.
std::string graph_dot(const monitor::State& state);

/// Seconds without a message until a port is silent.
inline constexpr double silent_after_s = 2;

} // namespace tandem::command
