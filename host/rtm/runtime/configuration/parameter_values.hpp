// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/ConfigAdmin.h>
#include <string>

namespace RTC {

/// What the variable of a parameter can hold, for a message ("a number (double)"), if it cannot hold this value. Empty:
/// it can, or nobody can tell, because the component converts the text by a function of its own.
std::string expected_instead(const ConfigBase& parameter, const std::string& value);

/// The same for a value of which the variable takes the beginning, as a number does of 0,5. Empty also if the default shows
/// that the component converts such texts by itself.
std::string expected_alone(const ConfigBase& parameter, const std::string& value);

/// Why ConfigAdmin::setConfigurationSetValues() has last returned false in this thread: a line; empty when there is no
/// such configuration set. Its result says that it failed, but OpenRTM-aist's interface has no place for the reason.
std::string& last_refused_value();

} // namespace RTC
