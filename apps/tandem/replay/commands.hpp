// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tandem::command {

struct ReplayOptions {
    std::filesystem::path file;
    std::string in_place_of; ///< opros_host, rtm_host or a shared component; empty: the absent host
    std::string link;        ///< current name of the recording's only link; empty: unchanged
    std::optional<double>
        rate; ///< recorded seconds per second; 0: as fast as possible; unset: 1, in lock-step 0
    bool step =
        false; ///< wait for a line of input before each tick, or without lock-step before each message
    std::filesystem::path lockstep; ///< folder of an application, as for tandem run; empty: real time
    std::vector<std::filesystem::path> plugin_dirs;
    bool check = false; ///< compare the system's answers
    bool times = false; ///< also compare the times of sending
    double wait_s = 60; ///< time limit for the peers
};

/// Runs `tandem replay` and returns the program's exit code. Errors are exceptions with a one-line message.
int replay(const ReplayOptions& options);

} // namespace tandem::command
