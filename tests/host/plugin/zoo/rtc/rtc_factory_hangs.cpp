// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/rtc.hpp"
#include <unistd.h>
extern "C" void rtc_factory_hangsInit(RTC::Manager* manager) {
    register_type(manager, "Waiter", [](RTC::Manager*) -> RTC::RTObject_impl* {
        for (;;) pause();
    });
}
