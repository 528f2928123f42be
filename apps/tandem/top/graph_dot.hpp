// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <string>

namespace tandem::command {

/// Hosts, what they share, and the ports between them, in the language of Graphviz (graphviz.org/doc/info/lang.html): a box
/// for each host with its components and links, an arrow for each port. Red: cannot be connected, or damaged; grey: without
/// a message for 2 s; dashed: services.
std::string graph_dot(const monitor::State& state);

/// Seconds without a message after which a port counts as silent.
inline constexpr double silent_after_s = 2;

} // namespace tandem::command
