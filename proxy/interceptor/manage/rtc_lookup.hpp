// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"

#include <string>

namespace tandem::interceptor {

/// The component of a name: `Name0` of this process, rtcname://HOST:PORT/CONTEXT/Name0.rtc or
/// rtcloc://HOST:PORT/Name0. Throws OperationFailed when nobody answers there.
RTC::RTObject_var find_rtc(RTC::Manager& manager, const std::string& name);

/// The same for a port, `Name0.port` instead of `Name0`.
RTC::PortService_var find_port(const std::string& name);

/// Throws OperationFailed, with `what`, unless the code is RTC_OK.
void require_ok(RTC::ReturnCode_t code, const std::string& what);

} // namespace tandem::interceptor
