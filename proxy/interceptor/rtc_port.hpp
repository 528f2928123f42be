// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <string>
#include <vector>

namespace tandem::interceptor {

/// A port of the RTC that is shared: its entry in the link's port table, and the CORBA object to connect with.
struct RtcPort {
    link::Port entry;
    std::string
        service_port; ///< of a service port: its own name, without the interface; empty for data ports
    RTC::PortService_var reference;
    bool is_remote = false; ///< of another process
};

/// The port's name without the leading instance name, which RTCs put into their profile: `Rtc0.out` -> `out`.
std::string short_name(const RTC::PortProfile& profile);

/// Whether the port is an InPort of this process that must be given each message when it comes, whether the RTC reads it or not:
/// it has listeners now, or the engine cannot give its connection a buffer of the link.
bool has_arrival_listener(RTC::PortService_ptr port);

/// Lists the ports of an RTC. A service port with several interfaces gives one entry for each, named
/// `port.instance`. Ports named `linkState` or `missedDeadline` are left out, because both proxies have such.
/// A data port whose type cannot cross has link::no_signature in its entry. Throws CORBA::Exception if the RTC does
/// not answer.
std::vector<RtcPort> enumerate_ports(RTC::RTObject_impl& rtc);
/// The same of an RTC of another process, called `component` here. `is_only`: of all RTCs of the link; otherwise the names of
/// its ports begin with its own, since it may not be known yet whether another has ports of the same names.
std::vector<RtcPort> enumerate_remote_ports(const RTC::PortServiceList& services,
                                            const std::string& component, bool is_only);

/// What a link shares of several RTCs.
struct SharedRtcs {
    std::vector<RtcPort> ports;
    link::PortTable table; ///< of these ports
};
/// Names of RTCs, which commas or, since those separate components in rtc.conf, semicolons separate.
std::vector<std::string> split_rtc_names(std::string names);
/// The ports of the RTCs of this process that have these names; those of other processes are left out. A port whose name
/// ports of several RTCs have is called RTC.PORT. Throws as enumerate_ports(), and for a name that no RTC has.
SharedRtcs enumerate_shared_ports(RTC::Manager& manager, const std::string& names);
/// The table of a link that shares these RTCs, with those of other processes, each of which is looked for once. Throws the
/// same, and why one is not there.
link::PortTable look_up_shared_ports(RTC::Manager& manager, const std::string& names);

} // namespace tandem::interceptor
