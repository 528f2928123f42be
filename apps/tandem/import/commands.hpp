// SPDX-License-Identifier: Apache-2.0
// `tandem opros import` and `tandem rtm import`. Each prints what it has written and what will differ, returns the exit
// code, and throws std::runtime_error with one line.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace tandem::command {

/// Of both.
struct ImportOptions {
    std::filesystem::path folder; ///< the installation
    std::filesystem::path output; ///< DIR of tandem run; empty: NAME-tandem in the current folder
    std::string link;             ///< name of a link that the side is to share; empty: none
    bool json = false;
};

/// Of `tandem opros import`.
struct OprosImportOptions : ImportOptions {
    std::string application; ///< name or file, if there are several
};
/// Writes DIR/opros from an installation of the OPRoS engine: the application profile, and its components' folders
/// without libraries of other builds.
int opros_import(const OprosImportOptions& options);

/// Of `tandem rtm import`.
struct RtmImportOptions : ImportOptions {
    std::filesystem::path conf;   ///< empty: the rtc.conf in the folder, if there is one
    std::filesystem::path system; ///< empty: the RTSystem profile in the folder, if there is one
    bool activate = false;        ///< activate the components of the profile when the host starts
};
/// Writes DIR/rtm from an rtc.conf and a profile of RTSystemEditor: rtc.conf and the files of settings that it names.
int rtm_import(const RtmImportOptions& options);

void add_opros_import(CLI::App& opros, std::function<int()>& selected);
void add_rtm_import(CLI::App& rtm, std::function<int()>& selected);

} // namespace tandem::command
