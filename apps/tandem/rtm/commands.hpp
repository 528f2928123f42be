// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem rtm`. Each returns the exit code, and throws std::runtime_error with one line.
#pragma once

#include "apps/tandem/build/plugin_build.hpp"

namespace tandem::command {

int rtm_new(const std::string& name, const std::filesystem::path& parent);

struct RtmBuildOptions : PluginBuildOptions {
    std::string name; ///< of the module, when the folder has several
};
int rtm_build(const RtmBuildOptions& options);

} // namespace tandem::command
