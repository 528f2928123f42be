// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/manage/built_in_service.hpp"

namespace tandem::interceptor {

/// Returns the service RtcConnector: connects ports of RTCs, disconnects them and lists their connections.
BuiltInService make_rtc_connector();

} // namespace tandem::interceptor
