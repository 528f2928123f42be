// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/wire/type.hpp"

#include <OPRoSTypes.h>

#include <string>

namespace tandem::adaptor {

/// Compares events whose content has the sample's type with the peer's message: an id (string) and the content, as a
/// structure or as its members, with or without RTM's leading time. Returns an empty string, or one line with both
/// signatures. `accepted` becomes the content's type if it fits.
std::string check_event_type(const opros_any& sample, const link::Port& peer, wire::Type* accepted = nullptr);

} // namespace tandem::adaptor
