// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"

#include <string>

namespace tandem::interceptor {

/// Returns the component with this name: `Name0` of this process, rtcname://HOST:PORT/CONTEXT/Name0.rtc or
/// rtcloc://HOST:PORT/Name0. Throws OperationFailed if nobody answers there.
RTC::RTObject_var find_rtc(RTC::Manager& manager, const std::string& name);

/// Returns the port with this name, `Name0.port` instead of `Name0`. Throws OperationFailed if there is none.
RTC::PortService_var find_port(const std::string& name);

/// Throws OperationFailed, with `what`, unless the code is RTC_OK.
void require_ok(RTC::ReturnCode_t code, const std::string& what);

} // namespace tandem::interceptor
