// SPDX-License-Identifier: Apache-2.0
// The modules of OpenRTM-aist 2.1 that rtc.conf files of real systems name. Their binaries need OpenRTM-aist's
// libraries, so they cannot be loaded here.
#pragma once
#include <string>
#include <vector>

namespace RTC {

struct OpenRtmModule {
    std::string name;     ///< without folder and suffix
    bool can_be_left_out; ///< components run just as well without it
    std::string instead;  ///< its substitute in Tandem, as the end of a message
};

const std::vector<OpenRtmModule>& openrtm_modules();

/// Returns the module of that file, `/a/NAME.so` or `NAME`, or NULL if OpenRTM-aist has no module of this name.
const OpenRtmModule* find_openrtm_module(const std::string& file);

} // namespace RTC
