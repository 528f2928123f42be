// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/rtc.hpp"
extern "C" void rtc_factory_returns_nullInit(RTC::Manager* manager) {
    register_type(manager, "Nothing", [](RTC::Manager*) -> RTC::RTObject_impl* { return nullptr; });
}
