// SPDX-License-Identifier: Apache-2.0
// Which ports of an OPRoS component and of the RTC behind its AdaptorComp belong together.
#pragma once

#include <OPRoSTypes.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tandem::command {

/// Two ports that could be connected by kind and direction. The ports are as describe_component() describes them.
struct PortPair {
    nlohmann::json opros, rtc;
    std::string error;   ///< why the connection is refused; empty if it can be made
    std::string matched; ///< "name" or "type"

    /// Whether the connection goes from the OPRoS port to the RTC's: from outputs and required services.
    bool from_opros() const { return opros["direction"] == "output" || opros["direction"] == "required"; }
};

struct PortMatch {
    std::vector<PortPair> pairs;
    std::vector<std::string> left_out; ///< a line for each port without a peer, with the reason
};

/// The type that connections of the port have.
PortType port_type(const nlohmann::json& port);

/// All pairs of ports of one kind whose directions fit.
std::vector<PortPair> possible_pairs(const nlohmann::json& opros_ports, const nlohmann::json& rtc_ports);

/// Chooses among the possible pairs, whose errors are known: ports of one name (case, `_` and `-` do not count), then
/// ports each of which is the only one left that fits the other. `opros`, `rtc`: the components' names, for the lines.
PortMatch match_ports(const std::string& opros, const nlohmann::json& opros_ports, const std::string& rtc,
                      const nlohmann::json& rtc_ports, const std::vector<PortPair>& possible);

} // namespace tandem::command
