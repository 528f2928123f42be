// SPDX-License-Identifier: Apache-2.0
// Matches the ports of an OPRoS component with the ports of the RTC behind its AdaptorComp.
#pragma once

#include <OPRoSTypes.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tandem::command {

/// Two ports whose kind and direction allow a connection, as describe_component() describes them.
struct PortPair {
    nlohmann::json opros, rtc;
    std::string error;   ///< why the connection is refused; empty if it is possible
    std::string matched; ///< "name" or "type"

    /// Returns whether data or calls go from the OPRoS port to the RTC's: from outputs and required services.
    bool from_opros() const { return opros["direction"] == "output" || opros["direction"] == "required"; }
};

struct PortMatch {
    std::vector<PortPair> pairs;
    std::vector<std::string> left_out; ///< a line with the reason for each port without a peer
};

/// Returns the connection type of the port.
PortType port_type(const nlohmann::json& port);

/// Returns all pairs of ports with the same kind and fitting directions.
std::vector<PortPair> possible_pairs(const nlohmann::json& opros_ports, const nlohmann::json& rtc_ports);

/// Chooses among the possible pairs with known errors: first ports with the same name (ignoring case, `_` and `-`),
/// then ports that fit only each other. `opros`, `rtc`: names of the components for the messages.
PortMatch match_ports(const std::string& opros, const nlohmann::json& opros_ports, const std::string& rtc,
                      const nlohmann::json& rtc_ports, const std::vector<PortPair>& possible);

} // namespace tandem::command
