// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/port_table.hpp"

#include <rtm/RTObject.h>

#include <string>

namespace tandem::interceptor {

/// A port of the RTC as the link shares it, and where it is.
struct RtcPort {
    link::Port entry;
    std::string corba_port; ///< service ports: name of the port that has the interface
    RTC::PortService_var service;
};

/// The ports of an RTC. A service port with several interfaces becomes one entry for each, `port.instance`.
/// A port named `linkState` is not shared: the two halves have one of that name.
/// Throws std::runtime_error, one line, for a data port whose type the process does not know.
std::vector<RtcPort> enumerate_ports(RTC::RTObject_impl& rtc);

} // namespace tandem::interceptor
