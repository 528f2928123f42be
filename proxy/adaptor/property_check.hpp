// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <string>
#include <vector>

namespace tandem::adaptor {

/// Returns a line for each property of a port, such as `names.PORT`, that has no effect, because the peer's table does not
/// have this port or the property belongs to the other side. The lines list the existing ports.
std::vector<std::string> find_properties_without_port(const std::vector<std::string>& properties,
                                                      const link::PortTable& peer);

/// Returns a line for each property that AdaptorComp does not know.
std::vector<std::string> find_unknown_properties(const std::vector<std::string>& properties);

} // namespace tandem::adaptor
