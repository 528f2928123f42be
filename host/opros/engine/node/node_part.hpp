// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/application_profile.hpp"

#include <map>
#include <string>
#include <vector>

namespace tandem::engine {

/// The part of an application that one node runs.
struct NodePart {
    std::string node;                         ///< empty: the application names no node
    ApplicationProfile application;           ///< the node's components, and the connections between them
    std::vector<ConnectionProfile> crossing;  ///< the connections between this node and another one; with an
                                              ///< error if <node_map> lacks an address
    std::map<std::string, std::string> nodes; ///< the node of each component of `crossing`
    std::vector<std::string> notices; ///< one line each: what of the profile does not hold across nodes
};

/// Returns the components of a node and those without a node, which run on every node, with their connections.
/// `application` is the result of flatten_composites(). `node` is the user's choice; if it is empty, <local_node_id>
/// holds, and then the only node that the components name. Throws SetupError if none of these selects a node that
/// exists, or a profile of the part was not found.
NodePart node_part(ApplicationProfile application, const std::string& node);

/// Returns the components that a check of this machine's files looks at, without composites: the part of `node` or
/// <local_node_id>, or all components if there is neither. A missing profile is not an error. Throws SetupError for a wrong
/// composite or node.
ApplicationProfile local_application(ApplicationProfile application,
                                     const std::vector<std::filesystem::path>& plugin_dirs,
                                     const std::string& node = "");

} // namespace tandem::engine
