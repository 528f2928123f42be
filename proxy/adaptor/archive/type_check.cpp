// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/archive/type_check.hpp"

#include "proxy/adaptor/archive/device_conversions.hpp"
#include "proxy/adaptor/archive/signature_archive.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/type_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::adaptor {
namespace {

using wire::Kind;
using wire::Type;

/// The cases of the union in `type` that has most of them; 0 if it has none.
std::size_t count_cases(const Type& type) {
    std::size_t most = type.kind == Kind::union_type ? type.children.size() - 1 : 0;
    for (const Type& child : type.children) most = std::max(most, count_cases(child));
    return most;
}

/// A value of the discriminator for that case; of the default case the first that no other case has.
std::int64_t label_of(const Type& type, const Type& chosen) {
    if (!chosen.labels.empty()) return chosen.labels.front();
    const auto is_taken = [&](std::int64_t value) {
        return std::any_of(type.children.begin() + 1, type.children.end(), [&](const Type& each) {
            return std::find(each.labels.begin(), each.labels.end(), value) != each.labels.end();
        });
    };
    std::int64_t value = 0;
    while (is_taken(value)) ++value;
    return value;
}

/// The type with each union replaced by a structure of its discriminator and its case number `run`. `values` gets
/// what a SignatureArchive has to give out so that load() takes that case.
Type choose_cases(const Type& type, std::size_t run, std::vector<long long>& values) {
    Type chosen = type;
    if (type.kind == Kind::union_type) {
        const Type& member = type.children[1 + run % (type.children.size() - 1)];
        values.push_back(label_of(type, member));
        chosen.kind = Kind::structure;
        chosen.children = {type.children.front(), choose_cases(member, run, values)};
        chosen.children.back().labels.clear();
        return chosen;
    }
    for (Type& child : chosen.children) child = choose_cases(child, run, values);
    // An any is asked for as a string and the octets of its value.
    if (type.children.empty()) values.insert(values.end(), type.kind == Kind::any ? 2 : 1, 0);
    return chosen;
}

Type load_type(const opros_any& sample, std::vector<long long> values) {
    SignatureArchive recorder(std::move(values));
    opros_any scratch(sample); // decode() overwrites it, and the sample belongs to the port
    scratch.decode(recorder);
    return wire::parse_signature(recorder.signature());
}

bool reads_every_case(const opros_any& sample, const Type& expected, std::size_t cases) {
    for (std::size_t run = 0; run < cases; ++run) {
        std::vector<long long> values;
        const Type chosen = wire::parse_signature(wire::to_signature(choose_cases(expected, run, values)));
        try {
            if (!wire::types_fit(load_type(sample, std::move(values)), chosen)) return false;
        } catch (const std::exception&) { // the type's own load() refuses that case
            return false;
        }
    }
    return true;
}

/// The first difference, with the time left aside where only the peer has one, since it is added by itself.
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
    // strip_time is no match here: the OPRoS value would have a time of which the peer's type knows nothing.
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

Type type_of(const opros_any& sample, const Type& peer) {
    if (const std::size_t cases = count_cases(peer); cases != 0) {
        if (reads_every_case(sample, peer, cases)) return peer;
        if (wire::is_timed(peer))
            if (Type rest = wire::without_time(peer); reads_every_case(sample, rest, cases)) return rest;
    }
    return load_type(sample, {});
}

TypeCheck check_type(const opros_any& sample, const link::Port& peer, bool sends,
                     const std::string& convert) {
    const auto refusal = [&](const std::string& why) {
        TypeCheck check;
        check.error = fmt::format("port '{}': OPRoS type {} {}", peer.name, sample.type(), why);
        return check;
    };
    if (!sample.serializable())
        return refusal("cannot cross the link: give it save() and load(), or save_this() and load_this()");
    try {
        const Type expected = wire::parse_signature(peer.signature);
        if (const auto reason = wire::first_unsupported(expected); !reason.empty())
            return refusal(fmt::format("has no counterpart: the peer's type {} cannot cross the link: {}",
                                       peer.type, reason));
        const Type own = type_of(sample, expected);
        TypeCheck check;
        const std::string device = device_conversion(sample.type(), peer.type, sends);
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
        if (check.error.empty()) return check;
        return refusal(fmt::format(
            "has signature '{}', the peer's type {} has '{}'; {} with convert.{} of AdaptorComp, "
            "or use a type with that signature, with or without the leading time '(uu)'",
            wire::to_signature(own), peer.type, wire::to_signature(expected), check.error, peer.name));
    } catch (const wire::SignatureError& error) { // the peer's: it came from another process
        return refusal(fmt::format("cannot be compared: {}", error.what()));
    } catch (const std::exception& error) { // thrown by the archive, or by the type's own load()
        return refusal(fmt::format("cannot cross the link: {}", error.what()));
    }
}

} // namespace tandem::adaptor
