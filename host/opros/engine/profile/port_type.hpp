// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OPRoSTypes.h>

#include <optional>
#include <string>

namespace tandem::engine {

/// Returns "data", "event" or "service", as in profiles and messages.
const char* port_type_name(PortType type);

/// Parses such a name in upper or lower case. Returns nullopt for any other word.
std::optional<PortType> parse_port_type(const std::string& name);

} // namespace tandem::engine
