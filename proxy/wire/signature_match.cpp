// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/signature_match.hpp"

#include "proxy/wire/type.hpp"

#include <fmt/format.h>

namespace tandem::wire {
namespace {

const Type& time_type() {
    static const Type time{Kind::structure, 0, {{Kind::uint32, 0, {}}, {Kind::uint32, 0, {}}}};
    return time;
}

bool starts_with_time(const Type& message) {
    return message.children.size() > 1 && message.children.front() == time_type();
}

/// The message without its leading time, in canonical form.
std::string untimed(const Type& message) {
    Type rest = message;
    rest.children.erase(rest.children.begin());
    return to_signature(parse_signature(to_signature(rest)));
}

} // namespace

SignatureMatch match_signatures(std::string_view from, std::string_view to) {
    const Type a = parse_signature(from), b = parse_signature(to);
    if (a == b) return SignatureMatch::equal;
    if (starts_with_time(a) && untimed(a) == to_signature(b)) return SignatureMatch::strip_time;
    if (starts_with_time(b) && untimed(b) == to_signature(a)) return SignatureMatch::add_time;
    return SignatureMatch::mismatch;
}

bool is_timed(std::string_view signature) { return starts_with_time(parse_signature(signature)); }

Operation parse_operation_signature(std::string_view signature) {
    const auto colon = signature.find(':');
    if (colon == std::string_view::npos || signature.find(':', colon + 1) != std::string_view::npos)
        throw SignatureError(
            fmt::format("operation signature '{}': 'arguments:result' was expected", signature));
    return {to_signature(parse_signature(signature.substr(0, colon))),
            to_signature(parse_signature(signature.substr(colon + 1)))};
}

} // namespace tandem::wire
