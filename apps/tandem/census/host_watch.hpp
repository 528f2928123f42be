// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/hosts/supervisor.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tandem::command {

/// What a host with one component did.
struct HostRecord {
    std::uint64_t cycles = 0;
    bool runs = false;        ///< the component was active until the end
    bool interrupted = false; ///< a signal asked this program to end
    std::string error;        ///< why it does not run, in one line
};

/// Runs a host until it has been ready for `seconds`, and stops it. `folder`: its working folder.
HostRecord watch_host(hosts::Supervisor& supervisor, const std::vector<std::string>& command,
                      const std::string& folder, double seconds);

} // namespace tandem::command
