// SPDX-License-Identifier: Apache-2.0
// The modules that come with OpenRTM-aist 2.1 and that rtc.conf files of real systems name. Their binaries need its
// own libraries, so they cannot be loaded here.
#pragma once
#include <string>
#include <vector>

namespace RTC {

struct OpenRtmModule {
    std::string name;     ///< without folder and suffix
    bool can_be_left_out; ///< components run as well without it
    std::string instead;  ///< what there is here in its place, as the end of a message
};

const std::vector<OpenRtmModule>& openrtm_modules();

/// The module of that file, `/a/NAME.so` or `NAME`; NULL when OpenRTM-aist has none of this name.
const OpenRtmModule* find_openrtm_module(const std::string& file);

} // namespace RTC
