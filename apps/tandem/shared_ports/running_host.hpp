// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

namespace tandem::command {

/// The ports that the RTM host shares on this link at the moment, read from shared memory without taking part; nothing if
/// no running host does. Throws std::runtime_error: the name is not that of a link, or what is there is damaged.
std::optional<link::PortTable> read_shared_ports(const std::string& link);

/// The mirrors of these ports as describe_component() describes ports, without types, which are compared when the ports
/// are connected; data and event ports with "signature", services, and ports of state machines, with the operations that
/// are known as "methods". `event_ports`: those that AdaptorComp's property of that name has.
nlohmann::json describe_mirrors(const link::PortTable& table, const std::set<std::string>& event_ports = {});

} // namespace tandem::command
