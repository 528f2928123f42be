// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/event/event_type.hpp"

#include "proxy/adaptor/archive/type_check.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/type.hpp"

#include <fmt/format.h>

#include <optional>

namespace tandem::adaptor {
namespace {

/// Returns the type that follows the id in the peer's message: a structure or its members, which have the same bytes in CDR.
/// Returns nothing if the message does not begin with a string.
std::optional<wire::Type> content_of(const link::Port& peer) {
    wire::Type message = wire::parse_signature(peer.signature);
    if (wire::is_timed(message)) message = wire::without_time(message);
    if (message.children.size() < 2 || message.children.front().kind != wire::Kind::string)
        return std::nullopt;
    message.children.erase(message.children.begin());
    return wire::parse_signature(wire::to_signature(message));
}

} // namespace

std::string check_event_type(const opros_any& sample, const link::Port& peer, wire::Type* accepted) {
    const auto content = content_of(peer);
    const std::string name = opros_any(sample).type();
    std::string own = "?";
    if (const auto why = why_not_archived(sample); !why.empty())
        return fmt::format("port '{}': events with content {} cannot cross the link: {}", peer.name, name,
                           why);
    try {
        const wire::Type type = type_of(sample, content.value_or(wire::Type{}));
        if (content && wire::is_assignable(type, *content)) {
            if (accepted) *accepted = type;
            return "";
        }
        own = wire::to_signature(type);
    } catch (const std::exception& error) { // of the archive, or of the type's own load()
        return fmt::format("port '{}': events with content {} cannot cross the link: {}", peer.name, name,
                           error.what());
    }
    return fmt::format(
        "port '{}': an event with content {} is 's{}' (its id and the content), the peer's type {} is "
        "'{}'; use a structure of a string and the content, with or without the leading time '(uu)'",
        peer.name, name, own, peer.type, wire::to_signature(wire::parse_signature(peer.signature)));
}

} // namespace tandem::adaptor
