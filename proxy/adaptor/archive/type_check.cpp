// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/archive/type_check.hpp"

#include "proxy/adaptor/archive/signature_archive.hpp"
#include "proxy/wire/type.hpp"

#include <fmt/format.h>

namespace tandem::adaptor {

std::string value_signature(const opros_any& sample) {
    SignatureArchive recorder;
    opros_any scratch(sample); // decode() overwrites it, and the sample belongs to the port
    scratch.decode(recorder);
    return wire::to_signature(wire::parse_signature(recorder.signature()));
}

TypeCheck check_type(const opros_any& sample, const link::Port& peer) {
    if (!sample.serializable())
        return {
            wire::SignatureMatch::mismatch,
            fmt::format(
                "port '{}': OPRoS type {} cannot cross the link: give it save() and load(), or save_this() "
                "and load_this()",
                peer.name, sample.type())};
    std::string signature;
    try {
        signature = value_signature(sample);
    } catch (const std::exception&) {
        // Thrown by the archive, or by the type's own load().
        return {
            wire::SignatureMatch::mismatch,
            fmt::format(
                "port '{}': OPRoS type {} cannot cross the link: it holds a long double or wide characters",
                peer.name, sample.type())};
    }
    const auto match = wire::match_signatures(signature, peer.signature);
    // strip_time is no match here: the OPRoS value would have a time of which the peer's type knows nothing.
    if (match == wire::SignatureMatch::equal || match == wire::SignatureMatch::add_time) return {match, ""};
    return {wire::SignatureMatch::mismatch,
            fmt::format(
                "port '{}': OPRoS type {} has signature '{}', the peer's type {} has '{}'; use a type with "
                "that signature, with or without the leading time '(uu)'",
                peer.name, sample.type(), signature, peer.type, peer.signature)};
}

} // namespace tandem::adaptor
