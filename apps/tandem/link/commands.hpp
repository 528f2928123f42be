// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem link`, a source file each. Each prints its result, returns the exit code, and throws
// std::runtime_error with one line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Of profile.
struct LinkProfileOptions {
    std::filesystem::path first, second; ///< folders of two components, one of each model, in either order
    std::filesystem::path out;           ///< the folder to write; empty: a new one named after the components
    std::string profile, type; ///< which component profile, which component type of the module, if several
    std::string link;          ///< name of the link; empty: after the components
    std::vector<std::string> properties; ///< of AdaptorComp, each NAME=VALUE
    bool initialize = false; ///< run the OPRoS component's onInitialize, for ports that are created there
    double timeout_s = 10;   ///< time limit for the components' code
    bool json = false;
};
/// Writes a folder with which `tandem run` joins two components, and prints which of their ports are connected and why
/// the others are not. 1 if no port is.
int link_profile(const LinkProfileOptions& options);

/// Of check.
struct LinkCheckOptions {
    std::filesystem::path folder;
    std::vector<std::filesystem::path> plugin_dirs;
    bool initialize = false; ///< run onInitialize of the OPRoS components, for ports that are created there
    double timeout_s = 10;   ///< time limit for the components' code
    bool json = false;
};
/// Prints every port of both sides of the links of an application with its peer, signatures and conversion, or why it
/// has none. 1 if a configured connection cannot be made.
int link_check(const LinkCheckOptions& options);

} // namespace tandem::command
