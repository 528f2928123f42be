// SPDX-License-Identifier: Apache-2.0
// The keys of rtc.conf: their names, the kind of value each takes, and which of them have an effect here.
// The names are those of OpenRTM-aist's DefaultConfiguration.h and component.conf, with a few of our own.
#pragma once
#include <string>
#include <vector>

namespace RTC {

/// One row of the table of known keys.
struct ConfKey {
    enum Value { text, yes_no, seconds, hertz, milliseconds, integer, cpu_list, log_level, naming_policy };
    const char* name; ///< `*`: one part of any name; a trailing `**`: one or more parts of any name
    Value value;
    bool used; ///< false: accepted because OpenRTM-aist has it, without effect here (see DIFFERENCES.md)
};

/// Returns all known keys. [any-thread]
const std::vector<ConfKey>& conf_keys();
/// Returns the row whose pattern matches `key`, or NULL if the key is unknown. [any-thread]
const ConfKey* find_conf_key(const std::string& key);

} // namespace RTC
