// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/manage/built_in_service.hpp"

namespace tandem::interceptor {

/// The service RtcConnector: connect, disconnect and list connections of ports of RTCs.
BuiltInService make_rtc_connector();

} // namespace tandem::interceptor
