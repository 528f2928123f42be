// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/xml_file.hpp"

namespace tandem::engine {

struct ComponentProfile;

/// Reads the <ports> of a component profile into its lists of ports. Throws SetupError if a queue size is not a
/// number or out of range, or if a queue policy is unknown. Skips a port without a name or with an unknown <usage>
/// and adds a line to `port_errors`: real profiles contain such ports, and the original engine ignores them.
void read_port_profiles(const XmlFile& xml, const pugi::xml_node& ports, ComponentProfile& profile);

} // namespace tandem::engine
