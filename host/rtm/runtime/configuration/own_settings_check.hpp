// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <coil/Properties.h>
#include <string>
#include <vector>

namespace RTC {

class RTObject_impl;

/// What is wrong with the settings that rtc.conf and the arguments of its creation give one component, a line each: keys
/// of `exec_cxt` and `port` that are unknown or have a wrong value, names that resemble those of its ports, and parameters
/// (`conf.SET.NAME`, and `NAME` alone in arguments) that the component does not have. `profile` is that of its type. To be
/// called after onInitialize, which binds the parameters and adds the ports.
std::vector<std::string> check_own_settings(RTObject_impl& component, const coil::Properties& profile,
                                            const coil::Properties& own_settings);

} // namespace RTC
