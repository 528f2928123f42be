// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Options of run.
struct RunOptions {
    std::filesystem::path folder;
    std::vector<std::filesystem::path> plugin_dirs;
    int restart = 0;              ///< maximum number of restarts per host
    double wait_s = 60;           ///< time limit for the hosts to become ready
    double grace_s = 20;          ///< time limit for their end; then they are killed
    bool lockstep = false;        ///< run cycles one after the other in simulated time, as fast as possible
    double duration_s = 0;        ///< of the lock-step, in simulated time; 0: until a signal
    std::filesystem::path record; ///< recording of the lock-step; empty: none
    std::string node;             ///< whose part of the application runs; empty: the profile's choice
    bool strict = false;          ///< the OPRoS host exits if a component or a connection is missing
    std::vector<std::string> host_arguments; ///< for both hosts
};
/// Starts the hosts with the folder's configuration and supervises them until a signal or until one ends.
/// Prints their output with the host's name before each line. Returns 0 if all hosts ended normally.
int run_hosts(const RunOptions& options);

} // namespace tandem::command
