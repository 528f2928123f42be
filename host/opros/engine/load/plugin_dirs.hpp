// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace tandem::engine {

/// Where component libraries and profiles are looked for beside their application: $TANDEM_PLUGIN_PATH, then what lies
/// beside this program, in the build tree and as installed.
std::vector<std::filesystem::path> default_plugin_dirs();

} // namespace tandem::engine
