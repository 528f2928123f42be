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

/// A time alone does not count: without it, the message would be empty.
bool starts_with_time(const Type& message) {
    return message.children.size() > 1 && message.children.front() == time_type();
}

/// Parsed once more, because what is left may be one structure, whose parentheses the canonical form lacks.
std::string signature_without_time(const Type& message) {
    Type rest = message;
    rest.children.erase(rest.children.begin());
    return to_signature(parse_signature(to_signature(rest)));
}

} // namespace

SignatureMatch match_signatures(std::string_view from, std::string_view to) {
    const Type sent = parse_signature(from), received = parse_signature(to);
    if (sent == received) return SignatureMatch::equal;
    if (starts_with_time(sent) && signature_without_time(sent) == to_signature(received))
        return SignatureMatch::strip_time;
    if (starts_with_time(received) && signature_without_time(received) == to_signature(sent))
        return SignatureMatch::add_time;
    return SignatureMatch::mismatch;
}

bool is_timed(std::string_view signature) { return starts_with_time(parse_signature(signature)); }

OperationSignature parse_operation_signature(std::string_view signature) {
    const auto colon = signature.find(':');
    if (colon == std::string_view::npos || signature.find(':', colon + 1) != std::string_view::npos)
        throw SignatureError(
            fmt::format("operation signature '{}': 'arguments:result' was expected", signature));
    return {to_signature(parse_signature(signature.substr(0, colon))),
            to_signature(parse_signature(signature.substr(colon + 1)))};
}

} // namespace tandem::wire
