// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/names/peer_names.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// AdaptorComp's properties, from its component profile or the application profile; the README of the project
/// describes them for users.
struct Settings {
    std::string link;                       ///< `link`: the name of the link, the same as InterceptorComp's
    std::chrono::milliseconds wait{10'000}; ///< `wait` [s]: how long to wait for the peer
    std::chrono::milliseconds call_timeout{1'000}; ///< `call_timeout` [ms]: of each call across the link
    std::size_t large_bytes = 0;                   ///< `large_kib`: longest message of a port, see README
    std::size_t segment_bytes =
        std::size_t{4} * 1024 * 1024; ///< `segment_mib`: for the objects of each side, without chunks
    std::vector<std::string>
        event_ports; ///< `event_ports`: data ports of the RTC that are mirrored as event ports
    /// `port_table`, for tools: the ports to mirror (link::encode_as_text()). No link is opened then.
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
    bool strict = false; ///< `strict`: a connection that is refused is an error when the component is started
    std::string group;   ///< `group`: may join the link beside the owner; empty: the owner only

    /// What is asked for the port; empty if nothing is.
    std::string conversion(const std::string& port) const {
        const auto at = conversions.find(port);
        return at == conversions.end() ? "" : at->second;
    }
    /// The port with the operations that are given for it, if the peer has told none.
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

/// Throws std::runtime_error, one line, when `link` is missing, another property is not a number above 0, or one has
/// another form than it should.
Settings read_settings(const std::map<std::string, std::string>& properties);

} // namespace tandem::adaptor
