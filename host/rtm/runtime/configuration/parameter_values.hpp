// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/ConfigAdmin.h>
#include <string>

namespace RTC {

/// If the variable of a parameter cannot hold this value, returns what it can hold, for a message ("a number
/// (double)"). Returns an empty string if it can, or if that is unknown because the component converts the text with
/// its own function.
std::string expected_instead(const ConfigBase& parameter, const std::string& value);

/// If the variable would take only the beginning of this value, as a number does of 0,5, returns what it can hold, for
/// a message. Returns an empty string if the component converts the text with its own function.
std::string expected_alone(const ConfigBase& parameter, const std::string& value);
/// Returns the beginning of the value that the variable takes then, for example `0`.
std::string used_beginning(const ConfigBase& parameter, const std::string& value);

/// Returns the line that says why ConfigAdmin::setConfigurationSetValues() last returned false in this thread; empty if there
/// is no such configuration set. OpenRTM-aist's interface has no place for the reason.
std::string& last_refused_value();

} // namespace RTC
