// SPDX-License-Identifier: Apache-2.0
// What keeps an application from running, before its hosts are started: for `tandem doctor DIR`.
#pragma once

#include "apps/tandem/doctor/check_result.hpp"

#include <filesystem>
#include <vector>

namespace tandem::command {

struct FolderCheckOptions {
    std::filesystem::path folder; ///< as of tandem run: opros/ with an application, rtm/rtc.conf
    std::vector<std::filesystem::path> plugin_dirs;
    double timeout_s = 10; ///< time limit for the components' code, which runs in child processes
};

/// The folder, the OPRoS components and all connections, the RTCs, and whether other hosts use the links now. Throws nothing
/// for what it finds.
std::vector<doctor::CheckResult> check_run_folder(const FolderCheckOptions& options);

} // namespace tandem::command
