// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/PortBase.h>

namespace RTC {

/// Lists the port, with its connections, for other processes (host/process/published/inventory.hpp), unless no component has
/// it. The caller holds the mutex of the profile.
void list_port(const PortBase* port, const PortProfile& profile);

} // namespace RTC
