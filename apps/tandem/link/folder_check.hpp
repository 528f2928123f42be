// SPDX-License-Identifier: Apache-2.0
// Finds problems of an application before its hosts start, for `tandem doctor DIR`.
#pragma once

#include "apps/tandem/doctor/check_result.hpp"

#include <filesystem>
#include <vector>

namespace tandem::command {

struct FolderCheckOptions {
    std::filesystem::path folder; ///< as for tandem run: opros/ with an application, rtm/rtc.conf
    std::vector<std::filesystem::path> plugin_dirs;
    double timeout_s = 10; ///< time limit for the components' code, which runs in child processes
};

/// Checks the folder, the OPRoS components, all connections and the RTCs, and whether other hosts use the links.
/// Reports problems as results, not as exceptions.
std::vector<doctor::CheckResult> check_run_folder(const FolderCheckOptions& options);

} // namespace tandem::command
