// SPDX-License-Identifier: Apache-2.0
// The keys of rtc.conf: which there are, what values they take, and which of them do something here.
#pragma once
#include <coil/Properties.h>
#include <map>
#include <string>
#include <vector>

namespace RTC {

/// Where a setting was made: `FILE:LINE` or `option -o`, by key.
using SettingOrigins = std::map<std::string, std::string>;

struct ConfKey {
    enum Value { text, yes_no, seconds, hertz, whole, processors, level, policy };
    const char* name; ///< `*`: one part of any name; a trailing `**`: whatever follows
    Value value;
    bool used; ///< false: it is OpenRTM-aist's and means nothing here
};

const std::vector<ConfKey>& conf_keys();
/// NULL: there is no such key.
const ConfKey* find_conf_key(const std::string& key);

/// May the key have this value? Words for yes and no become YES and NO.
bool normalize_value(const std::string& key, std::string& value);

/// Checks every setting that has a place. Words for yes and no become YES and NO. Returns one line for each
/// key that nobody knows. Throws ManagerError, beginning with the place, for a value a key cannot have.
std::vector<std::string> check_settings(coil::Properties& config, const SettingOrigins& places);

} // namespace RTC
