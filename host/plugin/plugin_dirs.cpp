// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/plugin_dirs.hpp"

#include <cstdlib>
#include <sstream>
#include <system_error>

namespace tandem::plugin {

std::vector<std::filesystem::path> default_plugin_dirs(const std::string& model) {
    std::vector<std::filesystem::path> dirs;
    const char* variable = std::getenv("TANDEM_PLUGIN_PATH");
    std::istringstream listed(variable ? variable : "");
    for (std::string dir; std::getline(listed, dir, ':');)
        if (!dir.empty()) dirs.emplace_back(dir);
    std::error_code ignored; // without /proc, there are only the listed folders
    const auto prefix = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
    if (ignored) return dirs;
    dirs.push_back(prefix / "plugins" / model);
    dirs.push_back(prefix / TANDEM_INSTALLED_PLUGINS / model);
    return dirs;
}

} // namespace tandem::plugin
