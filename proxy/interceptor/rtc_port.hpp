// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <string>
#include <vector>

namespace tandem::interceptor {

/// A port of a shared RTC: its entry in the link's port table, and the CORBA object to connect with.
struct RtcPort {
    link::Port entry;
    std::string
        service_port; ///< of a service port: its own name, without the interface; empty for data ports
    RTC::PortService_var reference;
    bool is_remote = false; ///< the RTC is in another process
};

/// Returns the port's name without the leading instance name, which RTCs put into their profile: `Rtc0.out` -> `out`.
std::string short_name(const RTC::PortProfile& profile);

/// Returns whether the port is an InPort of this process that must be given each message on arrival, even if the RTC does
/// not read: it has listeners now, or the engine cannot give its connection a buffer of the link.
bool has_arrival_listener(RTC::PortService_ptr port);

/// Lists the ports of an RTC. A service port with several interfaces gives one entry for each, named `port.instance`.
/// Leaves out ports named `linkState` or `missedDeadline`, because both proxies have such ports. The entry of a data port
/// whose type cannot cross has link::no_signature. Throws CORBA::Exception if the RTC does not answer.
std::vector<RtcPort> enumerate_ports(RTC::RTObject_impl& rtc);
/// Lists the ports of an RTC of another process, named `component` here. Unless `is_only`
/// (the only RTC of the link), its port names begin with its name, because RTCs that are not known yet may have such ports.
std::vector<RtcPort> enumerate_remote_ports(const RTC::PortServiceList& services,
                                            const std::string& component, bool is_only);

/// Everything that a link shares of several RTCs.
struct SharedRtcs {
    std::vector<RtcPort> ports;
    link::PortTable table; ///< of these ports
};
/// Splits names of RTCs at commas or semicolons. In rtc.conf, commas separate components.
std::vector<std::string> split_rtc_names(std::string names);
/// Returns the ports of the RTCs of this process with these names; leaves out RTCs of other processes. A port name that
/// several RTCs have becomes RTC.PORT. Throws like enumerate_ports(), and for a name that no RTC has.
SharedRtcs enumerate_shared_ports(RTC::Manager& manager, const std::string& names);
/// Returns the table of a link that shares these RTCs, including those of other processes; looks for each of the latter
/// once. Throws like enumerate_shared_ports(), and if an RTC is missing, with the reason.
link::PortTable look_up_shared_ports(RTC::Manager& manager, const std::string& names);

} // namespace tandem::interceptor
