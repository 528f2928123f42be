// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <ComponentDirectory.h>

#include <map>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Appends the ports of a component that can cross to `table`, under the names COMPONENT.PORT. An event port becomes a data
/// port whose messages contain the id and the content. `interfaces` maps COMPONENT.PORT to IDL names: `Module::Interface`,
/// optionally with `.instance`, for a service port, and `Module::Structure` for a data or event port. Returns a line for each
/// port and method that is left out: it cannot cross, or the application connects the required service port.
std::vector<std::string> describe_ports(const std::string& component_name, ComponentDirectory& directory,
                                        const std::map<std::string, std::string>& interfaces,
                                        link::PortTable& table);

} // namespace tandem::adaptor
