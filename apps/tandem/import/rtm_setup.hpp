// SPDX-License-Identifier: Apache-2.0
// The contents of an rtc.conf in separate parts. They are read from the installation, changed, and written to the
// output.
#pragma once

#include "apps/tandem/import/report.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tandem::command {

/// A setting. `origin`: FILE:LINE, or a file.
struct ConfSetting {
    std::string key, value, origin;
};

/// An entry of manager.components.precreate.
struct CreatedRtc {
    std::string entry, type, name; ///< entry: TYPE?KEY=VALUE&...; name: name of the created instance
    std::string origin;
};

struct RtmSetup {
    std::filesystem::path installation; ///< absolute; base of relative names in rtc.conf
    std::filesystem::path conf;         ///< absolute; empty if there is none
    std::filesystem::path output;       ///< DIR/rtm, or the folder that becomes it; absolute
    std::vector<std::filesystem::path> load_path;
    std::vector<std::string> modules; ///< entries of manager.modules.preload
    std::string modules_origin;       ///< place of these entries in rtc.conf
    std::vector<CreatedRtc> components;
    std::vector<std::string> connections, activations; ///< entries of preconnect and preactivation
    std::vector<ConfSetting> settings;                 ///< all other settings
    /// Settings files to copy: original path, and name in `output`.
    std::vector<std::pair<std::filesystem::path, std::string>> files;

    bool creates(const std::string& instance) const;
    /// Returns the name of the next instance of a type.
    std::string next_name(const std::string& type) const;
    const ConfSetting* find(const std::string& key) const;
    /// Returns an absolute file unchanged, otherwise the first match in the installation and in rtc.conf's folder, or
    /// "".
    std::filesystem::path resolve(const std::string& file) const;
    /// Returns the contents of rtc.conf. `writer`: the command that writes it.
    std::string text(const std::string& writer) const;
};

/// Returns rtc.conf, rtcd.conf, conf/rtc_cpp.conf or conf/rtc.conf of an installation; "" if there is none.
std::filesystem::path find_rtc_conf(const std::filesystem::path& installation);

/// Adds the settings of the file. Throws RTC::ManagerError with file and line if the file cannot be read or if a value
/// is invalid for its key.
void read_rtc_conf(RtmSetup& setup, ImportReport& report);

/// Copies the settings files that are not in `output` yet.
void copy_settings_files(const RtmSetup& setup, ImportReport& report);

/// Replaces modules by ones that rtm_host can load: renames modules of other systems, removes modules of other
/// languages and of OpenRTM-aist itself, and adds tasks to build missing ones.
void check_modules(RtmSetup& setup, ImportReport& report);

/// A library that `rtm_host` can load, or a source folder in the installation to build it from.
struct ModuleSource {
    std::filesystem::path library, folder; ///< at most one is not empty
    std::string unusable;                  ///< reason why the library found cannot be loaded
};
/// `function`: the module's init function; "": that of its name.
ModuleSource find_module(const RtmSetup& setup, const std::string& name, const std::string& function = "");

/// Adds the module of a type as an entry of preload, with a task if it must be built.
void add_module(RtmSetup& setup, const std::string& name, const std::string& origin, ImportReport& report,
                const std::string& function = "");

/// Returns whether connections can have the interface type: one of rtm_host, or possibly one of a module in preload.
bool has_interface_type(const RtmSetup& setup, const std::string& type);

/// Splits a list and trims its parts. Omits empty parts.
std::vector<std::string> split_list(const std::string& text);

} // namespace tandem::command
