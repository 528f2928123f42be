// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <coil/Properties.h>
#include <filesystem>

namespace RTC {

/// Reads a file of `key: value` lines as rtc.conf has them (`#` comment, `\` at the end continues) into
/// `out`. Throws ManagerError with file and line for what is no such line.
void read_conf_file(const std::filesystem::path& file, coil::Properties& out);

} // namespace RTC
