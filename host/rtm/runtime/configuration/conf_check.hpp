// SPDX-License-Identifier: Apache-2.0
#pragma once
// Checks settings against the table of known keys, so that a typing error in rtc.conf is reported with its
// file and line. OpenRTM-aist has no such check: it ignores unknown keys and takes the default for a value
// that it cannot read.
#include <coil/Properties.h>
#include <map>
#include <string>
#include <vector>

namespace RTC {

/// Writes a warning about a setting to the log, or to standard error if there is no log. It ignores `logger.enable` and
/// `logger.log_level`, because a setting without effect must not go unnoticed. Also publishes the warning
/// (host/process/published/notices.hpp). `name` is the name of the component or the manager. [any-thread]
void warn_about_setting(const std::string& name, const std::string& line);

/// Where each setting was made, by key: `FILE:LINE` or `option -o`.
using SettingOrigins = std::map<std::string, std::string>;

/// Rewrites `value` to the spelling that the rest of the runtime reads: YES or NO for the words of a boolean. Returns
/// false if the key cannot have this value. Unknown keys and empty values pass unchanged.
bool check_and_normalize_value(const std::string& key, std::string& value);

/// Returns the error in one setting as a line without its origin: an unknown key, with the most similar known key, or a
/// value that its key cannot have. Returns an empty string if there is no error.
std::string setting_error(const std::string& key, std::string value);

/// Returns the error in one property of a connector (`dataport.KEY`, `port.KEY`) as a line without its origin: a key that
/// resembles a known one, or a value that the key cannot have. Returns an empty string if there is no error.
std::string connector_property_error(const std::string& key, std::string value);

/// Returns one line about the settings that are accepted because OpenRTM-aist has them, and do nothing here. Returns an
/// empty string if there are none.
std::string settings_without_effect(const SettingOrigins& origins);

/// Checks and normalizes every setting of `config` that has an origin. Returns one warning for each unknown
/// key, with the nearest known one. Throws ManagerError, beginning with the origin, for a value that its key
/// cannot have.
std::vector<std::string> check_and_normalize_settings(coil::Properties& config,
                                                      const SettingOrigins& origins);

} // namespace RTC
