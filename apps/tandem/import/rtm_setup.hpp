// SPDX-License-Identifier: Apache-2.0
// What an rtc.conf sets up, in parts that can be changed one by one, from reading the installation's to writing ours.
#pragma once

#include "apps/tandem/import/report.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tandem::command {

/// `origin`: FILE:LINE, or a file.
struct ConfSetting {
    std::string key, value, origin;
};

/// An entry of manager.components.precreate.
struct CreatedRtc {
    std::string entry, type, name; ///< entry: TYPE?KEY=VALUE&...; name: of the instance that it makes
    std::string origin;
};

struct RtmSetup {
    std::filesystem::path installation; ///< absolute; relative names in rtc.conf start there
    std::filesystem::path conf;         ///< absolute; empty if there is none
    std::filesystem::path output;       ///< DIR/rtm, absolute
    std::vector<std::filesystem::path> load_path;
    std::vector<std::string> modules; ///< entries of manager.modules.preload
    std::string modules_origin;       ///< where rtc.conf names them
    std::vector<CreatedRtc> components;
    std::vector<std::string> connections, activations; ///< entries of preconnect and preactivation
    std::vector<ConfSetting> settings;                 ///< all others
    /// Files of settings that are copied: where from, and the name in `output`.
    std::vector<std::pair<std::filesystem::path, std::string>> files;

    bool creates(const std::string& instance) const;
    /// The name that the next instance of a type gets.
    std::string next_name(const std::string& type) const;
    const ConfSetting* find(const std::string& key) const;
    /// The file itself if it is absolute, else the first that there is in the installation and in rtc.conf's folder, else "".
    std::filesystem::path resolve(const std::string& file) const;
    std::string text() const; ///< of rtc.conf
};

/// The rtc.conf of an installation: rtc.conf, rtcd.conf, conf/rtc_cpp.conf or conf/rtc.conf in its folder; "" without one.
std::filesystem::path find_rtc_conf(const std::filesystem::path& installation);

/// Takes over what the file says. Throws RTC::ManagerError, a line with file and line, for one that cannot be read, and for
/// a value that its key cannot have.
void read_rtc_conf(RtmSetup& setup, ImportReport& report);

/// Replaces modules by those that rtm_host can load: of another system's name, of OpenRTM-aist itself, or built for it,
/// which is a task.
void check_modules(RtmSetup& setup, ImportReport& report);

/// A library of that name that `rtm_host` would find, or a source folder in the installation that it can be built from.
struct ModuleSource {
    std::filesystem::path library, folder; ///< at most one is not empty
    std::string unusable;                  ///< why a library that was found cannot be loaded
};
ModuleSource find_module(const RtmSetup& setup, const std::string& name);

/// Adds the module of a type, as an entry of preload, with a task if it is to be built.
void add_module(RtmSetup& setup, const std::string& name, const std::string& origin, ImportReport& report);

/// The parts of a list, without blanks around them; empty ones are left out.
std::vector<std::string> split_list(const std::string& text);

} // namespace tandem::command
