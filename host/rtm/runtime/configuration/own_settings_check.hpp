// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <coil/Properties.h>
#include <string>
#include <vector>

namespace RTC {

class RTObject_impl;

/// Returns the errors in the settings that rtc.conf and the creation arguments give one component, one line each: keys
/// of `exec_cxt` and `port` that are unknown or have an invalid value, names that resemble those of its ports, and
/// parameters that the component does not have (`conf.SET.NAME`, or just `NAME` in arguments). `profile` is the profile
/// of its type. Call it after onInitialize, which binds the parameters and adds the ports.
std::vector<std::string> check_own_settings(RTObject_impl& component, const coil::Properties& profile,
                                            const coil::Properties& own_settings);

} // namespace RTC
