// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/hosts/supervisor.hpp"
#include "apps/tandem/run/commands.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// The configuration of an application in a folder: FOLDER/opros/*.xml, of which one is an application profile, and
/// FOLDER/rtm/rtc.conf. One of the two may be missing, and is empty then. Absolute.
struct RunFolder {
    std::filesystem::path application, rtc_conf;
    std::vector<std::string> conf_warnings{}; ///< of settings that rtm_host does not know, a line each
};

/// Reads both files, so that nothing is started on one that is there and cannot be used. Throws std::runtime_error: a
/// file that cannot be read, neither of the two, several application profiles.
RunFolder find_run_folder(const std::filesystem::path& folder);

/// How the hosts are started on it, each in the folder of its configuration.
std::vector<hosts::HostCommand> host_commands(const RunFolder& folder, const RunOptions& options);

} // namespace tandem::command
