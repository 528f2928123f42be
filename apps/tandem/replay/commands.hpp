// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

struct ReplayOptions {
    std::filesystem::path file;
    std::string in_place_of; ///< opros_host, rtm_host or a component that a side shares; empty: who is absent
    std::string link;        ///< the recording's one link has this name now; empty: the same names
    double rate = 1;         ///< recorded seconds in a second; 0: as fast as it goes
    bool step = false;       ///< each tick, or without lock-step each message, waits for a line of input
    std::filesystem::path lockstep; ///< the folder of an application, as of tandem run; empty: real time
    std::vector<std::filesystem::path> plugin_dirs;
    bool check = false; ///< compare what the system answers
    bool times = false; ///< also the times of sending
    double wait_s = 60; ///< time limit for the peers
};

/// `tandem replay`: returns the program's exit code; errors are exceptions of one line.
int replay(const ReplayOptions& options);

} // namespace tandem::command
