// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/archive/union_cases.hpp"

#include "proxy/wire/signature_match.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

namespace tandem::adaptor {

using wire::Kind;
using wire::Type;

namespace {

/// Returns a value of the discriminator for that case; for the default case, the first value that no other case has.
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

} // namespace

std::size_t count_union_cases(const Type& type) {
    std::size_t max_cases = type.kind == Kind::union_type ? type.children.size() - 1 : 0;
    for (const Type& child : type.children) max_cases = std::max(max_cases, count_union_cases(child));
    return max_cases;
}

Type choose_union_cases(const Type& type, std::size_t run, std::vector<long long>& values) {
    Type chosen = type;
    if (type.kind == Kind::union_type) {
        const Type& member = type.children[1 + run % (type.children.size() - 1)];
        values.push_back(label_of(type, member));
        chosen.kind = Kind::structure;
        chosen.children = {type.children.front(), choose_union_cases(member, run, values)};
        chosen.children.back().labels.clear();
        return chosen;
    }
    for (Type& child : chosen.children) child = choose_union_cases(child, run, values);
    // load() reads an any as a string and the octets of its value.
    if (type.children.empty()) values.insert(values.end(), type.kind == Kind::any ? 2 : 1, 0);
    return chosen;
}

bool is_chosen_type(const std::string& loaded, const Type& chosen) {
    return wire::is_assignable(wire::parse_signature(loaded),
                               wire::parse_signature(wire::to_signature(chosen)));
}

} // namespace tandem::adaptor
