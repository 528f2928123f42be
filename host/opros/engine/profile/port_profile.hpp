// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/xml_file.hpp"

namespace tandem::engine {

struct ComponentProfile;

/// Reads the <ports> of a component profile into its lists of ports. Throws SetupError for a queue size that
/// is no number or out of range, and for an unknown queue policy. A port without a name, or whose <usage> is
/// none of the two, is left out, with a line in `port_errors`: real profiles have such ports, and the original
/// engine ignores them.
void read_port_profiles(const XmlFile& xml, const pugi::xml_node& ports, ComponentProfile& profile);

} // namespace tandem::engine
