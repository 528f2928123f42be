// SPDX-License-Identifier: Apache-2.0
// Registers the proxy's components for the plugin, so that the plugin needs none of their headers.
#pragma once

namespace RTC {
class Manager;
}

namespace tandem::interceptor {

/// Registers InterceptorComp and OprosRtc. InterceptorComp creates one OprosRtc for each shared OPRoS component.
void register_factories(RTC::Manager& manager);

} // namespace tandem::interceptor
