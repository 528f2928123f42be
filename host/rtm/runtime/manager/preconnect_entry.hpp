// SPDX-License-Identifier: Apache-2.0
// Entries of manager.components.preconnect and the connections that they ask for.
#pragma once
#include <rtm/Manager.h>

namespace RTC {

/// One entry of manager.components.preconnect: the first port is connected with each of the others. A port without others
/// is connected by itself: its transport finds the other side.
struct PreconnectEntry {
    std::vector<std::string> ports; ///< `Component.port`, with rtcname:// or rtcloc:// before it when remote
    coil::Properties properties;    ///< of the connector, with the prefix `dataport.` or `port.`

    /// Returns `index` of each second port; 0 for a port that is connected by itself.
    std::vector<std::size_t> connections() const;
    /// Returns the names of the first port and ports[index] with `separator` between; the first name alone for 0.
    std::string port_names(std::size_t index, const char* separator) const;
};
/// Parses `A.p?port=B.q&key=value...`, `A.p?interface_type=x&...` or, in the form of 1.x, `A.p:B.q(key=value&...)`.
/// Throws ManagerError.
PreconnectEntry parse_preconnect_entry(const std::string& text);

/// Returns whether the name of the port has a scheme (rtcname://, rtcloc://).
bool is_remote(const std::string& port_name);

/// Resolves a port name to a reference, which the caller releases. Calls another process for a remote port. Throws
/// ManagerError for an invalid name, RemoteUnavailable for a remote port that may appear later.
PortService_ptr find_port(Manager& manager, const std::string& port_name);

/// Connects entry.ports[0] (`first`) with entry.ports[index] (`second`), or by itself if `index` is 0. Returns the
/// connector's id. Throws ManagerError when a port refuses, RemoteUnavailable when a remote port does not answer.
std::string connect_ports(const PreconnectEntry& entry, std::size_t index, PortService_ptr first,
                          PortService_ptr second);

} // namespace RTC
