// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/xml_file.hpp"

namespace tandem::engine {

/// Reads the ports that a component profile lists. Throws SetupError for a number or a queue policy that is
/// none; a port that is neither input nor output, or has no name, is passed over, as real profiles have such.
void read_ports(const XmlFile& xml, const pugi::xml_node& ports, ComponentProfile& profile);

} // namespace tandem::engine
