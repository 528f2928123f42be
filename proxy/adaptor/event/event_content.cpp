// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/event/event_content.hpp"

#include "proxy/adaptor/archive/cdr_archive.hpp"

namespace tandem::adaptor {

opros_any content_of(EventPort& port) { return port.sample(); }
opros_any content_of(Event&) { return {}; }

void encode_content(const opros_any& value, wire::CdrWriter& out) {
    CdrOarchive archive(out);
    value.encode(archive);
}

} // namespace tandem::adaptor
