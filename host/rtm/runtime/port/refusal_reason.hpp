// SPDX-License-Identifier: Apache-2.0
// The operations that connect ports return a code only. Their profile goes back to the caller, too, also from another
// process: with it the reason, in a property of ours.
#pragma once
#include <rtm/RTC.h>
#include <string>

namespace RTC {

/// Why a port has refused the connection; empty: it does not say, as ports of OpenRTM-aist. [any-thread]
std::string refusal_reason(const ConnectorProfile& profile);
/// Sets the reason, or removes it if it is empty. [any-thread]
void set_refusal_reason(ConnectorProfile& profile, const std::string& reason);

} // namespace RTC
