// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <ComponentDirectory.h>

#include <map>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Appends the ports of a component that can cross, under the names COMPONENT.PORT: data ports, event ports as data ports
/// of an id and the content, service ports. `interfaces` are IDL names by COMPONENT.PORT: `Module::Interface`, optionally
/// with `.instance`, for a service port, and `Module::Structure` for a data or event port. Leaves out required service
/// ports that the application connects. Returns a line for each port and method that cannot cross.
std::vector<std::string> describe_ports(const std::string& component_name, ComponentDirectory& directory,
                                        const std::map<std::string, std::string>& interfaces,
                                        link::PortTable& table);

} // namespace tandem::adaptor
