// SPDX-License-Identifier: Apache-2.0
// The functions of `tandem opros import` and `tandem rtm import`. Each prints the written files, the remaining tasks
// and the differences, and returns the exit code. Each throws std::runtime_error with a one-line message.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace tandem::command {

/// Options of both commands.
struct ImportOptions {
    std::filesystem::path folder; ///< folder of the installation
    std::filesystem::path output; ///< DIR of tandem run; empty: NAME-tandem in the current folder
    std::string link;             ///< name of a link to share; empty: none
    bool json = false;
};

/// Options of `tandem opros import`.
struct OprosImportOptions : ImportOptions {
    std::string application; ///< name or file; needed if there are several
};
/// Writes DIR/opros from an installation of the OPRoS engine: the application profile and the components' folders.
/// Skips libraries that opros_host cannot load.
int opros_import(const OprosImportOptions& options);

/// Options of `tandem rtm import`.
struct RtmImportOptions : ImportOptions {
    std::filesystem::path conf;   ///< empty: the rtc.conf in the folder, if any
    std::filesystem::path system; ///< empty: the RTSystem profile in the folder, if any
    bool activate = false;        ///< activate the profile's components when the host starts
};
/// Writes DIR/rtm from an rtc.conf and an RTSystemEditor profile: rtc.conf and the settings files that it names.
int rtm_import(const RtmImportOptions& options);

void add_opros_import(CLI::App& opros, std::function<int()>& selected);
void add_rtm_import(CLI::App& rtm, std::function<int()>& selected);

} // namespace tandem::command
