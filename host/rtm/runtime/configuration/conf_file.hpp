// SPDX-License-Identifier: Apache-2.0
// Reads files in the format of rtc.conf: the text format of coil::Properties, which is that of Java's
// .properties files.
#pragma once
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include <filesystem>

namespace RTC {

/// Returns the beginning of a text from outside, for one line of a message: at most 60 bytes, with control characters
/// replaced by `?`.
std::string printable(const std::string& text);

/// Reads a file of `key: value` lines (`#` begins a comment, `\` at the end continues a line) into `out`, and
/// the origin of each setting into `origins`. Throws ManagerError with file and line when a line is not a
/// setting, when the file is not regular text of at most 1 MB, or when it has more than 10,000 settings.
void read_conf_file(const std::filesystem::path& file, coil::Properties& out,
                    SettingOrigins* origins = nullptr);

} // namespace RTC
