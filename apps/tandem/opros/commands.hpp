// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem opros`, one source file each. Each function prints its result and returns the exit code.
// Each throws std::runtime_error with a one-line message.
#pragma once

#include "apps/tandem/build/plugin_build.hpp"
#include "host/plugin/probe_child.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Options of info and check. Component code runs only in a child process. Its crash, exit or hang becomes a one-line
/// error.
struct InspectOptions {
    std::filesystem::path file;
    std::vector<std::filesystem::path> plugin_dirs;
    bool initialize = false; ///< run onInitialize, which can create ports, in a child process
    double timeout_s = 10;   ///< time limit for the component's code
    bool json = false;
    std::filesystem::path rtc_conf; ///< for check: of the RTM host on the links; empty: ../rtm/rtc.conf
    std::string node{};             ///< for check: whose part of the application; empty: the profile's choice
};
/// Prints the contents of a component library or of a profile of any kind.
int opros_info(const InspectOptions& options);
/// The problems of an application, one line each.
struct ApplicationReport {
    std::string name;
    std::size_t components = 0, connections = 0;
    std::size_t not_checked = 0;            ///< connections of components whose ports are currently unknown
    std::vector<std::string> errors, notes; ///< notes: may be intended
    std::vector<std::string> unknown;       ///< about these components
};
/// Checks an application against its components. Throws std::runtime_error if its profile cannot be read.
ApplicationReport check_application(const InspectOptions& options);
/// Prints the report of check_application(). Returns 1 if there are errors.
int opros_check(const InspectOptions& options);

/// Creates the folder parent/name with a component that builds, and prints the next two commands. Throws if the folder
/// exists or if the name clashes with C++ or the OPRoS API.
int opros_new(const std::string& name, const std::filesystem::path& parent);

/// Options of `tandem opros build`.
struct OprosBuildOptions : PluginBuildOptions {
    std::string profile; ///< component profile to use, if the folder has several
};
/// Builds a component's library and prints its path. Throws if the folder has no profile, or several and none is
/// selected.
int opros_build(const OprosBuildOptions& options);

/// Returns the tasks of child processes for info and check, see probe_tasks.hpp.
plugin::ProbeTasks opros_probe_tasks();

} // namespace tandem::command
