// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"

#include <EventPort.h>

namespace tandem::adaptor {

// How a port for events learns at connection what the other one's events hold: from the port, or where ports do not tell
// (engine::ports_show_content) from an event that it shows. [one thread]

/// A value of the content's type; empty when that is not known, or none that crosses.
opros_any content_of(EventPort& port);
opros_any content_of(Event& event);

/// Writes a value of a type that crosses. Throws what archives throw.
void encode_content(const opros_any& value, wire::CdrWriter& out);

} // namespace tandem::adaptor
