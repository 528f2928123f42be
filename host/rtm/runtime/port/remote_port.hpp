// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/naming/local_object.hpp"
#include <rtm/PortBase.h>

namespace RTC {

/// Returns whether a port of the connection is in another process. [any-thread]
inline bool has_remote_port(const ConnectorProfile& profile) {
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i)
        if (local_object<PortBase>(profile.ports[i]) == nullptr) return true;
    return false;
}

} // namespace RTC
