// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"

#include <EventPort.h>

namespace tandem::adaptor {

// How an event port learns at connection what the events of the other port contain: from that port, or, if ports do not
// tell (engine::ports_show_content), from a sample event. [one thread]

/// Returns a value of the content's type; empty if the type is unknown or cannot cross.
opros_any content_of(EventPort& port);
opros_any content_of(Event& event);

/// Writes a value of a type that crosses. Throws the exceptions of archives.
void encode_content(const opros_any& value, wire::CdrWriter& out);

} // namespace tandem::adaptor
