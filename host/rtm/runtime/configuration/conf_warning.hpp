// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace RTC {

/// Writes a warning about a setting to the log, or to standard error if there is none: whatever `logger.enable` and
/// `logger.log_level` say, since a setting that has no effect must not pass in silence. `name`: of the component or the
/// manager. [any-thread]
void warn_about_setting(const std::string& name, const std::string& line);

} // namespace RTC
