// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/configuration/conf_keys.hpp"
#include <filesystem>

namespace RTC {

/// Text from outside as part of one line of a message: its beginning, without control characters.
std::string printable(const std::string& text);

/// Reads a file of `key: value` lines as rtc.conf has them (`#` comment, `\` at the end continues) into
/// `out`; where each stands into `places`. Throws ManagerError with file and line for what is no such line.
void read_conf_file(const std::filesystem::path& file, coil::Properties& out,
                    SettingOrigins* places = nullptr);

} // namespace RTC
