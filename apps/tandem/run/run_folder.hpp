// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/hosts/supervisor.hpp"
#include "apps/tandem/run/commands.hpp"
#include "host/opros/engine/node/node_part.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// The configuration of an application in a folder: the application profile among FOLDER/opros/*.xml, and
/// FOLDER/rtm/rtc.conf. One of them may be missing (empty). Paths are absolute.
struct RunFolder {
    std::filesystem::path application, rtc_conf;
    std::vector<std::string> conf_warnings{}; ///< unknown settings of rtm_host, one per line
};

/// Finds and reads both files, so that no host starts with an unusable file. Throws std::runtime_error if a
/// file is unreadable, both are missing, or there are several application profiles.
RunFolder find_run_folder(const std::filesystem::path& folder);

/// Returns the part of the application that runs on options.node, with the files of its components. Throws
/// engine::SetupError if the choice of the node, or a profile, would end opros_host.
engine::NodePart find_node_part(const RunFolder& folder, const RunOptions& options);

/// Returns whether components of options.node have connections with other nodes, which rtm_host makes.
bool has_node_connections(const RunFolder& folder, const RunOptions& options);

/// Returns the commands that start the hosts, each in the folder of its configuration.
std::vector<hosts::HostCommand> host_commands(const RunFolder& folder, const RunOptions& options);

} // namespace tandem::command
