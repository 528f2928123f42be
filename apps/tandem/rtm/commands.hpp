// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem rtm`. Each returns the exit code, and throws std::runtime_error with one line.
#pragma once

#include "apps/tandem/build/plugin_build.hpp"

namespace tandem::command {

/// Creates the folder parent/name with a component that builds and runs, and prints the next two commands. Throws if
/// the folder exists or the name cannot be that of a C++ class.
int rtm_new(const std::string& name, const std::filesystem::path& parent);

/// Of build: the common options, and the module.
struct RtmBuildOptions : PluginBuildOptions {
    std::string name; ///< of the module to build; empty: all that the folder has
};
/// Builds NAME.so from the sources and IDL files in the folder, for each module, and prints its path. Nothing else goes
/// to standard output unless a build fails, so that scripts can use it.
int rtm_build(const RtmBuildOptions& options);

} // namespace tandem::command
