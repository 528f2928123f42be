// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/interceptor/manage/built_in_service.hpp"

namespace tandem::interceptor {

/// Returns the service RtcManager: load, create, list, configure, activate, deactivate, reset, exit, state. `manager` must
/// outlive it.
BuiltInService make_rtc_manager(RTC::Manager& manager);

} // namespace tandem::interceptor
