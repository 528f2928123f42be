// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/Manager.h>

namespace RTC {

/// One entry of manager.components.preconnect: the first port is connected with each of the others.
struct ConnectionLine {
    std::vector<std::string> ports; // `Component.port`, or with rtcname:// or rtcloc:// before it
    coil::Properties properties;
};
/// Throws ManagerError.
ConnectionLine parse_connection(const std::string& line);

bool is_remote(const std::string& port_name);
/// Throws ManagerError for a port that cannot be, NotThere for a remote one that may come yet.
PortService_ptr find_port(Manager& manager, const std::string& port_name);
/// Connects two ports; the id of the connection. Throws ManagerError, or NotThere.
std::string connect_ports(const ConnectionLine& line, std::size_t other, PortService_ptr first,
                          PortService_ptr second);

} // namespace RTC
