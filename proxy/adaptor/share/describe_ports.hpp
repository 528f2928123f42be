// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <ComponentDirectory.h>

#include <map>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Appends those ports of a component that can cross, under the names COMPONENT.PORT: data ports, event ports as data
/// ports of an id and the content, service ports. `interfaces` are IDL names by COMPONENT.PORT: of a service port
/// `Module::Interface`, with `.instance` behind it or without, of a data or event port `Module::Structure`. Required
/// service ports that the application connects are left out. Returns a line for each port and method that cannot cross.
std::vector<std::string> describe_ports(const std::string& component_name, ComponentDirectory& directory,
                                        const std::map<std::string, std::string>& interfaces,
                                        link::PortTable& table);

} // namespace tandem::adaptor
