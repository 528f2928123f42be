// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "conf_keys.hpp"
#include <filesystem>

namespace RTC {

/// Reads a file of `key: value` lines as rtc.conf has them (`#` comment, `\` at the end continues) into
/// `out`; where each stands into `places`. Throws ManagerError with file and line for what is no such line.
void read_conf_file(const std::filesystem::path& file, coil::Properties& out, Places* places = nullptr);

} // namespace RTC
