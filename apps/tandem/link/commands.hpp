// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem link`, one source file each. Each function prints its result and returns the exit code.
// Each throws std::runtime_error with a one-line message.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Options of `tandem link profile`.
struct LinkProfileOptions {
    std::filesystem::path first, second; ///< folders of an OPRoS component and an RTC, in any order
    std::filesystem::path out;           ///< folder to write; empty: a new one named after the components
    std::string profile, type; ///< component profile and type in the module; needed if there are several
    std::string link;          ///< name of the link; empty: from the components' names
    std::vector<std::string> properties; ///< NAME=VALUE, for AdaptorComp
    bool initialize = false;             ///< run onInitialize of the OPRoS component, which can create ports
    double timeout_s = 10;               ///< time limit for the components' code
    bool json = false;
};
/// Writes a folder for `tandem run` that joins two components. Prints the connected ports, and for the other ports the
/// reason why they are not connected. Throws std::runtime_error if no port can be connected.
int link_profile(const LinkProfileOptions& options);

/// Options of `tandem link check`.
struct LinkCheckOptions {
    std::filesystem::path folder;
    std::vector<std::filesystem::path> plugin_dirs;
    bool initialize = false; ///< run onInitialize of the OPRoS components, which can create ports
    double timeout_s = 10;   ///< time limit for the components' code
    bool json = false;
};
/// Prints each port on both sides of an application's links with its peer, signatures and conversion, or the reason why
/// it has no peer. Returns 1 if a configured connection is not possible.
int link_check(const LinkCheckOptions& options);

} // namespace tandem::command
