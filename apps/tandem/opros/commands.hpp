// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem opros`, a source file each. Each prints its result, returns the exit code, and throws
// std::runtime_error with one line.
#pragma once

#include "apps/tandem/build/plugin_build.hpp"
#include "host/plugin/probe_child.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Of info and check.
/// Component code runs in a child process only: its crash, exit or hang becomes an error of one line.
struct InspectOptions {
    std::filesystem::path file;
    std::vector<std::filesystem::path> plugin_dirs;
    bool initialize = false; ///< run onInitialize in a child process, for ports that are created there
    double timeout_s = 10;   ///< time limit for the component's code
    bool json = false;
    std::filesystem::path
        rtc_conf; ///< check: of the RTM host at the other end of links; empty: ../rtm/rtc.conf
};
/// Prints what a component library or a profile of any kind contains.
int opros_info(const InspectOptions& options);
/// What does not fit in an application, a line each.
struct ApplicationReport {
    std::string name;
    std::size_t components = 0, connections = 0;
    std::size_t not_checked = 0;            ///< connections of components whose ports are not known now
    std::vector<std::string> errors, notes; ///< notes: what need not be wrong
    std::vector<std::string> unknown;       ///< about those components
};
/// Checks an application against its components. Throws std::runtime_error if its profile cannot be read.
ApplicationReport check_application(const InspectOptions& options);
/// The same, printed: one line for each error; 1 if there is any.
int opros_check(const InspectOptions& options);

/// Creates the folder parent/name with a component that builds.
/// Prints the next two commands. Throws if the folder exists or the name clashes with C++ or the OPRoS API.
int opros_new(const std::string& name, const std::filesystem::path& parent);

/// Of build: the common options, and the profile.
struct OprosBuildOptions : PluginBuildOptions {
    std::string profile; ///< component profile to use, if the folder has several
};
/// Builds a component's library and prints its path. Throws if the folder has no profile, or several and none is named.
int opros_build(const OprosBuildOptions& options);

/// What a child process of this program does for info and check, see probe_tasks.hpp.
plugin::ProbeTasks opros_probe_tasks();

} // namespace tandem::command
