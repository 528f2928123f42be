// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/archive/type_check.hpp"

#include "proxy/adaptor/archive/device_conversions.hpp"
#include "proxy/adaptor/archive/pictures.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/type_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::adaptor {
namespace {

using wire::Type;

/// Returns the first difference. Ignores a leading time that only the peer has, because it is added automatically.
std::string describe_difference(const Type& own, const Type& peer, bool sends) {
    const bool time_is_added = wire::is_timed(peer) && !wire::is_timed(own);
    return wire::first_difference(own, time_is_added ? wire::without_time(peer) : peer, sends);
}

Type without_leading_time(const Type& type) { return wire::is_timed(type) ? wire::without_time(type) : type; }

/// The conversion that the request describes. Throws wire::ConversionError.
TypeCheck converted(const Type& own, const Type& peer, bool sends, const std::string& text) {
    const auto request = wire::parse_conversion_request(text);
    TypeCheck check;
    check.value_has_time = wire::is_timed(own);
    check.set_time = request.set_time;
    if (check.value_has_time && !wire::is_timed(peer) && !(sends ? request.drop_time : request.set_time))
        throw wire::ConversionError(
            fmt::format("field 'tm' is here and missing there: ask for '{} tm'", sends ? "drop" : "set"));
    const Type mine = without_leading_time(own), theirs = without_leading_time(peer);
    check.conversion.emplace(sends ? mine : theirs, sends ? theirs : mine, request, sends);
    if (check.conversion->is_identity()) check.conversion.reset();
    return check;
}

/// The result for types that fit as they are; an error if they do not.
TypeCheck unconverted(const Type& own, const Type& peer, bool sends) {
    TypeCheck check;
    const auto match = wire::match_signatures(wire::to_signature(own), wire::to_signature(peer));
    check.error = describe_difference(own, peer, sends);
    const bool fits = match == wire::SignatureMatch::equal || match == wire::SignatureMatch::add_time;
    // strip_time is not a match here: the OPRoS value would have a time that the peer's type lacks.
    if (match == wire::SignatureMatch::strip_time)
        check.error =
            fmt::format("field 'tm' is here and missing there: ask for '{} tm'", sends ? "drop" : "set");
    if (!fits || !check.error.empty()) return check;
    check.value_has_time = wire::is_timed(own) && wire::is_timed(peer);
    if (sends && wire::needs_check(without_leading_time(own), without_leading_time(peer)))
        return converted(own, peer, sends, "positions");
    return check;
}

} // namespace

TypeCheck check_type(const opros_any& sample, const link::Port& peer, bool sends,
                     const std::string& convert) {
    const std::string own_name = opros_any(sample).type();
    const auto refusal = [&](const std::string& why) {
        TypeCheck check;
        check.error = fmt::format("port '{}': OPRoS type {} {}", peer.name, own_name, why);
        return check;
    };
    if (const auto why = why_not_archived(sample); !why.empty())
        return refusal("cannot cross the link: " + why);
    try {
        const Type expected = wire::parse_signature(peer.signature);
        if (const auto reason = wire::first_unsupported(expected); !reason.empty())
            return refusal(fmt::format("has no counterpart: the peer's type {} cannot cross the link: {}",
                                       peer.type, reason));
        const Type own = type_of(sample, expected);
        TypeCheck check;
        const std::string device = device_conversion(own_name, without_leading_time(own), peer.type, sends);
        try {
            const bool by_device = !device.empty() && (convert.empty() || convert == "device");
            if (convert.empty() && !by_device)
                check = unconverted(own, expected, sends);
            else if (convert == "device" && !by_device)
                return refusal(fmt::format("has no device conversion to or from {}", peer.type));
            else
                check = converted(own, expected, sends, by_device ? device : convert);
        } catch (const wire::ConversionError& error) {
            check.error = error.what();
        }
        check.pictures = pictures_in(without_leading_time(own));
        if (check.error.empty()) return check;
        const bool can_be_asked = !convert.empty() || check.error.find("ask for") != std::string::npos;
        const std::string remedy =
            can_be_asked ? fmt::format(" with convert.{} of AdaptorComp, or use", peer.name) : ", to";
        return refusal(fmt::format("has signature '{}', the peer's type {} has '{}'; {}{} a type with that "
                                   "signature, with or without the leading time '(uu)'",
                                   wire::to_signature(own), peer.type, wire::to_signature(expected),
                                   check.error, remedy));
    } catch (const wire::SignatureError& error) { // the peer's signature, which came from another process
        return refusal(fmt::format("cannot be compared: {}", error.what()));
    } catch (const std::exception& error) { // thrown by the archive, or by the type's own load()
        return refusal(fmt::format("cannot cross the link: {}", error.what()));
    }
}

} // namespace tandem::adaptor
