// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include "host/rtm/runtime/configuration/manager_start.hpp"
#include <coil/Properties.h>
#include <string>
#include <vector>

namespace RTC {

/// Returns how a manager of this process is started.
ManagerStart start_of_this_process(std::vector<std::string> arguments);

/// Reads the settings that a user made for a manager into `config`, and the origin of each into `origins`: those of the
/// configuration file, overridden by the options of the command line. Returns the file's name, as the manager's process
/// names it; "": none. Throws ManagerError, one line, for a file or an option that cannot be read.
std::string read_manager_settings(const ManagerStart& start, coil::Properties& config,
                                  SettingOrigins& origins);

} // namespace RTC
