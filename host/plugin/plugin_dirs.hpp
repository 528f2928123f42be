// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::plugin {

/// Returns the folders that are searched for component libraries and profiles after those that the user's files name:
/// those of $TANDEM_PLUGIN_PATH (separated by ':'), then the plugin folders beside this program, in the build tree and
/// as installed. `model`: opros or rtm. Folders that do not exist may be among them.
std::vector<std::filesystem::path> default_plugin_dirs(const std::string& model);

} // namespace tandem::plugin
