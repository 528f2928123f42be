// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/configuration/conf_warning.hpp"
#include <rtm/SystemLogger.h>

namespace RTC {

void warn_about_setting(const std::string& name, const std::string& line) {
    Logger(name.c_str()).write(Logger::RTL_WARN, line);
}

} // namespace RTC
