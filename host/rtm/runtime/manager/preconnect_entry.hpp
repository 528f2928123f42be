// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/Manager.h>

namespace RTC {

/// One entry of manager.components.preconnect: the first port is connected with each of the others.
struct PreconnectEntry {
    std::vector<std::string> ports; // `Component.port`, or with rtcname:// or rtcloc:// before it
    coil::Properties properties;
};
/// Throws ManagerError.
PreconnectEntry parse_preconnect_entry(const std::string& line);

bool is_remote(const std::string& port_name);
/// Throws ManagerError for a port that cannot be, RemoteUnavailable for a remote one that may come yet.
PortService_ptr find_port(Manager& manager, const std::string& port_name);
/// Connects two ports; the id of the connection. Throws ManagerError, or RemoteUnavailable.
std::string connect_ports(const PreconnectEntry& line, std::size_t other, PortService_ptr first,
                          PortService_ptr second);

} // namespace RTC
