// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include <coil/Properties.h>
#include <string>

namespace RTC {

/// The manager's options of a command line. Settings made here win over those of rtc.conf.
struct CommandLine {
    std::string conf_file;                 ///< -f FILE; empty: not given
    bool conf_file_may_be_missing = false; ///< -i
    coil::Properties settings;             ///< -o KEY:VALUE, and what -p, -a and -d stand for
    SettingOrigins origins;                ///< `option -o` ... for each of them

    void set(const std::string& option, const std::string& key, const std::string& value);
};

/// Ignores options that are not the manager's, because they belong to the component's program. Throws ManagerError for
/// an option without its value.
CommandLine parse_command_line(int argc, char** argv);

} // namespace RTC
