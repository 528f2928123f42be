// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <rtm/Manager.h>
#include <rtm/RTObject.h>

#include <string>
#include <vector>

namespace tandem::interceptor {

/// A port of the RTC that is shared: its entry in the link's port table, and the CORBA object to connect with.
struct RtcPort {
    link::Port entry;
    std::string
        service_port; ///< of a service port: its own name, without the interface; empty for data ports
    RTC::PortService_var reference;
};

/// The port's name without the leading instance name, which RTCs put into their profile: `Rtc0.out` -> `out`.
std::string short_name(const RTC::PortProfile& profile);

/// Whether the port is an InPort of this process with listeners that are called when a message comes, whether the RTC
/// reads it or not: those that it has now.
bool has_arrival_listener(RTC::PortService_ptr port);

/// Lists the ports of an RTC. A service port with several interfaces gives one entry for each, named
/// `port.instance`. Ports named `linkState` or `missedDeadline` are left out, because both proxies have such.
/// A data port whose type cannot cross has link::no_signature in its entry. Throws CORBA::Exception if the RTC does
/// not answer.
std::vector<RtcPort> enumerate_ports(RTC::RTObject_impl& rtc);

/// What a link shares of several RTCs.
struct SharedRtcs {
    std::vector<RtcPort> ports;
    link::PortTable table; ///< of these ports
};
/// The ports of the RTCs of these names, which commas or, since those separate components in rtc.conf, semicolons
/// separate. A port whose name ports of several RTCs have is called RTC.PORT. Throws as
/// enumerate_ports(), and for a name that no RTC has.
SharedRtcs enumerate_shared_ports(RTC::Manager& manager, std::string names);

} // namespace tandem::interceptor
