// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/names/peer_names.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// AdaptorComp's properties, from its component profile or the application profile. docs/joining.md describes them for
/// users.
struct Settings {
    std::string link;                       ///< `link`: the name of the link, the same as InterceptorComp's
    std::chrono::milliseconds wait{10'000}; ///< `wait` [s]: how long to wait for the peer
    std::chrono::milliseconds call_timeout{1'000}; ///< `call_timeout` [ms]: of each call across the link
    std::size_t large_bytes = 0;                   ///< `large_kib`: longest message of a port
    std::size_t segment_bytes =
        std::size_t{4} * 1024 * 1024; ///< `segment_mib`: memory of each side, without chunks
    std::vector<std::string>
        event_ports; ///< `event_ports`: data ports of the RTC that are mirrored as event ports
    /// `port_table`, for tools: the ports to mirror (link::encode_as_text()). Then no link is opened.
    std::string port_table;
    std::vector<std::string> share; ///< `share`: names of the OPRoS components that are shown as RTCs
    /// `interfaces`: the IDL interface, `Module::Interface`, of a shared provided service port, by COMPONENT.PORT
    std::map<std::string, std::string> interfaces;
    std::map<std::string, std::string> conversions; ///< `convert.PORT`: see wire::ConversionRequest
    std::map<std::string, PeerNames> names;         ///< `names.PORT`
    /// `operations.PORT`: of a service port whose IDL the RTM host does not know
    std::map<std::string, std::vector<link::ServiceOperation>> operations;
    std::map<std::string, std::string>
        policies;        ///< `keep_last`, `wait_ms`, `deadline_ms`, and `.PORT` for one port
    bool strict = false; ///< `strict`: a setting without effect or a refused connection prevents the start
    std::string group;   ///< `group`: may join the link, like the owner; empty: only the owner

    /// Returns the conversion requested for the port; empty if there is none.
    std::string conversion(const std::string& port) const {
        const auto at = conversions.find(port);
        return at == conversions.end() ? "" : at->second;
    }
    /// Returns the port with the operations configured for it, if the peer has sent none.
    link::Port with_operations(link::Port port) const {
        const auto at = operations.find(port.name);
        if (at != operations.end() && !link::is_data_port(port.kind) && port.operations.empty())
            port.operations = at->second;
        return port;
    }
    PeerNames names_of(const std::string& port) const {
        const auto at = names.find(port);
        return at == names.end() ? PeerNames() : at->second;
    }
};

/// Throws std::runtime_error, one line, if `link` is missing, a number is not above 0, or another property is malformed.
Settings read_settings(const std::map<std::string, std::string>& properties);

} // namespace tandem::adaptor
