// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/link/made_conversion.hpp"

#include "proxy/wire/signature_match.hpp"

#include <algorithm>

namespace tandem::command {
namespace {

using wire::Type;

bool has_union(const Type& type) {
    return type.kind == wire::Kind::union_type ||
           std::any_of(type.children.begin(), type.children.end(), has_union);
}

/// The class for an IDL union has the signature of one case only, because its load() shows only this case.
std::string of_union(const Type& sent, const Type& received) {
    if (wire::is_timed(sent) == wire::is_timed(received)) return "union";
    return wire::is_timed(received) ? "union, tm is set" : "union, tm is left out";
}

} // namespace

std::string made_conversion(const std::string& sent, const std::string& received) {
    switch (wire::match_signatures(sent, received)) {
    case wire::SignatureMatch::equal:
        return "";
    case wire::SignatureMatch::add_time:
        return "tm is set";
    case wire::SignatureMatch::strip_time:
        return "tm is left out";
    case wire::SignatureMatch::mismatch:
        break;
    }
    const Type from = wire::parse_signature(sent), to = wire::parse_signature(received);
    if (has_union(from) || has_union(to)) return of_union(from, to);
    return "device"; // the only other conversion that happens without a request
}

} // namespace tandem::command
