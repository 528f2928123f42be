// SPDX-License-Identifier: Apache-2.0
// Registers the proxy's components for the plugin, which so needs none of their headers.
#pragma once

namespace RTC {
class Manager;
}

namespace tandem::interceptor {

/// Registers InterceptorComp and OprosRtc, of which the former makes one for each shared OPRoS component.
void register_factories(RTC::Manager& manager);

} // namespace tandem::interceptor
