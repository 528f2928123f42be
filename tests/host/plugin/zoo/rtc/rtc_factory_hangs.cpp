// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/rtc.hpp"
#include <unistd.h>
extern "C" void ZOO_INIT(RTC::Manager* manager) {
    register_type(manager, "Waiter", [](RTC::Manager*) -> RTC::RTObject_impl* {
        for (;;) pause();
    });
}
