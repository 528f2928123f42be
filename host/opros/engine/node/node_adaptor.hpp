// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/node/node_part.hpp"

namespace tandem::engine {

/// Returns the name of the link between the hosts of a node, for an application with connections between nodes.
std::string node_link(const NodePart& part);

/// Adds an AdaptorComp to the part. It shares the components with connections to other nodes, unless another one shares
/// them, so that rtm_host shows them to the other machines as RTCs. Does nothing without such components. Throws
/// SetupError if the profile of AdaptorComp is missing or the application has a component of the same name.
void add_node_adaptor(NodePart& part, const std::vector<std::filesystem::path>& plugin_dirs);

} // namespace tandem::engine
