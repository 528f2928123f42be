// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace RTC {

/// How the process of a manager was started, as far as it decides which settings the manager has.
struct ManagerStart {
    std::vector<std::string> arguments;       ///< the first one is the program
    std::optional<std::string> conf_variable; ///< RTC_MANAGER_CONFIG of its environment
    /// Returns the path, for this process, of a file that the manager's process names. The two differ if the manager is
    /// another process.
    std::function<std::filesystem::path(const std::string& file)> path_of;
};

} // namespace RTC
