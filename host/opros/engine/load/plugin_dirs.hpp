// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace tandem::engine {

/// Returns the folders that are searched for component libraries and profiles after the application's own: those of
/// $TANDEM_PLUGIN_PATH (separated by ':'), then the plugin folders beside this program, in the build tree and
/// as installed. Folders that do not exist may be among them.
std::vector<std::filesystem::path> default_plugin_dirs();

} // namespace tandem::engine
