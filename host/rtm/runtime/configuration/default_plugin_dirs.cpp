// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/configuration/default_plugin_dirs.hpp"
#include <coil/stringutil.h>
#include <cstdlib>

namespace RTC {

std::vector<std::filesystem::path> default_plugin_dirs() {
    namespace fs = std::filesystem;
    std::vector<fs::path> dirs;
    if (const char* path = std::getenv("TANDEM_PLUGIN_PATH"))
        for (const auto& dir : coil::split(path, ":", true)) dirs.emplace_back(dir);
    std::error_code ignored;
    const fs::path root = fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
    dirs.push_back(root / "plugins/rtm");
    for (const char* lib : {"lib", "lib64"}) dirs.push_back(root / lib / "tandem/plugins/rtm");
    for (const auto& entry : fs::directory_iterator(root / "lib", ignored)) // lib/ARCHITECTURE-linux-gnu
        if (entry.is_directory() && fs::exists(entry.path() / "tandem/plugins/rtm"))
            dirs.push_back(entry.path() / "tandem/plugins/rtm");
    return dirs;
}

} // namespace RTC
