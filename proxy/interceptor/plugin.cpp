// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/factory.hpp"

// What an RTM manager looks up in a module: the library's name followed by Init.
extern "C" void InterceptorCompInit(RTC::Manager* manager) {
    tandem::interceptor::register_factories(*manager);
}
