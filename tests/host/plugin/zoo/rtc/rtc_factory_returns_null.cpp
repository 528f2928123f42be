// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/rtc.hpp"
extern "C" void ZOO_INIT(RTC::Manager* manager) {
    register_type(manager, "Nothing", [](RTC::Manager*) -> RTC::RTObject_impl* { return nullptr; });
}
