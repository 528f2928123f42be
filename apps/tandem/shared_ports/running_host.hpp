// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

namespace tandem::command {

/// Returns the ports that a running RTM host shares on this link, read from shared memory without joining; nullopt if
/// there are none. Throws std::runtime_error if the link name is invalid or the segment is damaged.
std::optional<link::PortTable> read_shared_ports(const std::string& link);

/// Describes the mirrors of these ports as describe_component() does. Types are null, because they are compared on
/// connection. Data and event ports have "signature". Services and state machine ports have "methods" with the known
/// operations. `event_ports`: names in AdaptorComp's property of that name.
nlohmann::json describe_mirrors(const link::PortTable& table, const std::set<std::string>& event_ports = {});

} // namespace tandem::command
