// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <string>
#include <vector>

namespace tandem::link {

/// A line for each of these properties of AdaptorComp that is one of a port, as `names.PORT`, which the RTCs of the table do
/// not have: it would have no effect, and nobody would notice. The lines name the ports that they have.
std::vector<std::string> find_properties_without_port(const std::vector<std::string>& properties,
                                                      const PortTable& table);

} // namespace tandem::link
