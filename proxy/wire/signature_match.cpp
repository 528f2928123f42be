// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/signature_match.hpp"

#include <algorithm>

namespace tandem::wire {
namespace {

const Type& time_type() {
    static const Type time{Kind::structure, 0, {{Kind::uint32, 0, {}}, {Kind::uint32, 0, {}}}};
    return time;
}

/// Returns the type whose form a foreign type has when it crosses.
const Type* crossing_form(Kind kind) {
    static const Type integer{Kind::uint32, 0, {}}, text{Kind::string, 0, {}},
        signature_and_value{
            Kind::structure, 0, {{Kind::string, 0, {}}, {Kind::sequence, 0, {{Kind::octet, 0, {}}}}}};
    switch (kind) {
    case Kind::enumeration:
    case Kind::int32:
        return &integer;
    case Kind::fixed:
    case Kind::object:
        return &text;
    case Kind::any:
        return &signature_and_value;
    default:
        return nullptr;
    }
}

bool members_are_assignable(const Type& from, const Type& to) {
    return std::equal(
        from.children.begin(), from.children.end(), to.children.begin(), to.children.end(),
        [](const Type& a, const Type& b) { return a.labels == b.labels && is_assignable(a, b); });
}

} // namespace

bool is_assignable(const Type& from, const Type& to) {
    if (from.kind == Kind::unsupported || to.kind == Kind::unsupported) return false;
    // A structure of one member has the bytes of that member.
    const auto is_wrapped = [](const Type& one, const Type& other) {
        return one.kind == Kind::structure && one.children.size() == 1 && other.children.size() > 1;
    };
    if (is_wrapped(from, to)) return is_assignable(from.children.front(), to);
    if (is_wrapped(to, from)) return is_assignable(from, to.children.front());
    if (from.kind == to.kind)
        return (from.kind != Kind::array || from.count == to.count) && members_are_assignable(from, to);
    // One of two different types must be foreign to the other model: an int is not an unsigned.
    const auto is_integer = [](Kind kind) { return kind == Kind::int32 || kind == Kind::uint32; };
    if (is_integer(from.kind) && is_integer(to.kind)) return false;
    const Type* const from_form = crossing_form(from.kind);
    const Type* const to_form = crossing_form(to.kind);
    if (!from_form && !to_form) return false;
    return (from_form ? *from_form : from) == (to_form ? *to_form : to);
}

bool needs_check(const Type& from, const Type& to) {
    switch (to.kind) {
    case Kind::sequence:
    case Kind::string:
    case Kind::wide_string:
    case Kind::enumeration:
        if (to.count != 0 && (from.kind != to.kind || from.count == 0 || from.count > to.count)) return true;
        break;
    case Kind::fixed:
    case Kind::any:
    case Kind::union_type:
        return true;
    default:
        break;
    }
    for (std::size_t i = 0; i < std::min(from.children.size(), to.children.size()); ++i)
        if (needs_check(from.children[i], to.children[i])) return true;
    return false;
}

/// A time alone does not count: without it, the message would be empty.
bool is_timed(const Type& message) {
    return message.kind == Kind::structure && message.children.size() > 1 &&
           is_assignable(message.children.front(), time_type());
}

bool is_timed(std::string_view signature) { return is_timed(parse_signature(signature)); }

/// Parses once more, because the rest may be one structure, whose parentheses the canonical form lacks.
Type without_time(const Type& message) {
    Type rest = message;
    rest.children.erase(rest.children.begin());
    return parse_signature(to_named_signature(rest));
}

SignatureMatch match_signatures(std::string_view from, std::string_view to) {
    const Type sent = parse_signature(from), received = parse_signature(to);
    if (is_assignable(sent, received)) return SignatureMatch::equal;
    if (is_timed(sent) && is_assignable(without_time(sent), received)) return SignatureMatch::strip_time;
    if (is_timed(received) && is_assignable(sent, without_time(received))) return SignatureMatch::add_time;
    return SignatureMatch::mismatch;
}

} // namespace tandem::wire
