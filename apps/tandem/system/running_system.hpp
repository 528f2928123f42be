// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::command {

/// The hosts of a running system and the files from which they run, absolute. A host that does not run has the pid 0.
struct RunningSystem {
    pid_t rtm = 0, opros = 0;
    std::filesystem::path rtc_conf, application;
};

/// Finds the hosts with these process ids, or the only ones of this user if there are none. Throws std::runtime_error with
/// one line if a process is not a host, or if there are several hosts of a model.
RunningSystem find_running_system(const std::vector<pid_t>& pids);

/// Writes DIR/rtm/rtc.conf with the connections, active RTCs and configuration sets of the running host. Returns a line for
/// each thing that it leaves out.
std::vector<std::string> save_rtm(const RunningSystem& system, const std::filesystem::path& output);

/// Writes the application into DIR/opros with the properties of the running components. Returns lines like save_rtm().
std::vector<std::string> save_opros(const RunningSystem& system, const std::filesystem::path& output);

} // namespace tandem::command
