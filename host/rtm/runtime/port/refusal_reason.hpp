// SPDX-License-Identifier: Apache-2.0
// The operations that connect ports return only a code. But their profile also returns to the caller, even from another
// process. A property of Tandem in it carries the reason.
#pragma once
#include <rtm/RTC.h>
#include <string>

namespace RTC {

/// Returns why a port has refused the connection. Empty if the port gives no reason, as ports of OpenRTM-aist.
/// [any-thread]
std::string refusal_reason(const ConnectorProfile& profile);
/// Sets the reason, or removes it if it is empty. [any-thread]
void set_refusal_reason(ConnectorProfile& profile, const std::string& reason);

} // namespace RTC
