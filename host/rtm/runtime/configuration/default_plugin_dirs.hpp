// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <vector>

namespace RTC {

/// Folders in which programs of Tandem search component libraries after manager.modules.load_path: those of
/// $TANDEM_PLUGIN_PATH, then those of the build or the installation that the program belongs to.
std::vector<std::filesystem::path> default_plugin_dirs();

} // namespace RTC
