// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem system`. Each function prints its result and returns the exit code. Each throws
// std::runtime_error with a one-line message.
#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::command {

/// Prints the systems in a folder, which `tandem run` can run, and the built components. Runs none of their code.
int system_list(const std::filesystem::path& folder, bool json);

/// Options of `tandem system new`.
struct NewSystemOptions {
    std::filesystem::path folder; ///< to write
    std::vector<std::filesystem::path>
        components;        ///< their folders, profiles or modules; several times: several of them
    double timeout_s = 10; ///< time limit for the components' code
};
/// Writes a folder for `tandem run` with these components, without connections.
int system_new(const NewSystemOptions& options);

/// Options of `tandem system save`.
struct SaveSystemOptions {
    std::filesystem::path folder; ///< to write
    std::vector<pid_t> hosts;     ///< at most one of each model; empty: the only ones of this user
    bool replace = false;         ///< change the files of the folder from which the hosts run
};
/// Writes a folder for `tandem run` with the components, connections and settings of running hosts.
int system_save(const SaveSystemOptions& options);

} // namespace tandem::command
