// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/RTC.h>
#include <string>

namespace RTC {

/// Returns why the ports of a connection cannot share memory, namely that one of them is on another machine; empty if
/// they can.
std::string shared_memory_obstacle(const ConnectorProfile& profile);

} // namespace RTC
