// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace RTC {

/// Writes a warning about a setting to the log, or to standard error if there is no log. It ignores `logger.enable` and
/// `logger.log_level`, because a setting without effect must not go unnoticed. `name` is the name of the component or
/// the manager. [any-thread]
void warn_about_setting(const std::string& name, const std::string& line);

} // namespace RTC
