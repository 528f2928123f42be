// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem opros`. Each returns the exit code, and throws std::runtime_error with one
// line.
#pragma once

#include "apps/tandem/build/plugin_build.hpp"
#include "host/plugin/probe_child.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

struct InspectOptions {
    std::filesystem::path file;
    std::vector<std::filesystem::path> plugin_dirs;
    bool initialize = false; ///< ports that onInitialize makes are wanted, too: it is run, in a child process
    double timeout_s = 10;   ///< bound for the component's code
    bool json = false;
};
int opros_info(const InspectOptions& options);
int opros_check(const InspectOptions& options);

int opros_new(const std::string& name, const std::filesystem::path& parent);

struct OprosBuildOptions : PluginBuildOptions {
    std::string profile; ///< which one, when the folder has several
};
int opros_build(const OprosBuildOptions& options);

/// What a child process of this program does for info and check.
plugin::ProbeTasks opros_probe_tasks();

} // namespace tandem::command
