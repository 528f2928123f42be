// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/event/event_content.hpp"

#include "proxy/adaptor/typed/value_type.hpp"

namespace tandem::adaptor {

opros_any content_of(EventPort&) { return {}; }
opros_any content_of(Event& event) {
    const auto* type = find_content_type(event);
    return type ? type->sample() : opros_any();
}

void encode_content(const opros_any& value, wire::CdrWriter& out) {
    opros_any scratch(value); // the public API cannot read a constant opros_any
    const auto* type = find_value_type(scratch.type());
    if (!type) throw opros::archive::archive_type_exception();
    type->encode(scratch, out);
}

} // namespace tandem::adaptor
