// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem rtm`. Each function returns the exit code and throws std::runtime_error with a one-line
// message.
#pragma once

#include "apps/tandem/build/plugin_build.hpp"

namespace tandem::command {

/// Creates the folder parent/name with a component that builds and runs, and prints the next two commands. Throws if
/// the folder exists or the name is not valid for a C++ class.
int rtm_new(const std::string& name, const std::filesystem::path& parent);

/// Options of `tandem rtm build`.
struct RtmBuildOptions : PluginBuildOptions {
    std::string name; ///< module to build; empty: all in the folder
};
/// Builds NAME.so for each module from the sources and IDL files in the folder, and prints its path. Prints nothing
/// else to standard output unless a build fails, so that scripts can use it.
int rtm_build(const RtmBuildOptions& options);

} // namespace tandem::command
