// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OPRoSTypes.h>

#include <optional>
#include <string>

namespace tandem::engine {

/// "data", "event" or "service": the words of profiles and messages.
const char* port_type_name(PortType type);

/// The opposite, in either case; nullopt for any other word.
std::optional<PortType> parse_port_type(const std::string& name);

} // namespace tandem::engine
