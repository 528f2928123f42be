// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/typed/value_type.hpp"

#include "proxy/wire/signature_match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace tandem::adaptor {
namespace {

template <class... T>
ValueTypes make_types() {
    ValueTypes types;
    (add_value_type<T>(types), ...);
    (add_value_type<std::vector<T>>(types), ...);
    (add_value_type<std::vector<std::vector<T>>>(types), ...);
    add_users_values(types);
    return types;
}

/// If several types have the same signature, the first one represents it.
const ValueTypes& value_types() {
    static const ValueTypes types =
        make_types<bool, unsigned char, char, signed char, short, unsigned short, int, unsigned int,
                   long long, unsigned long long, long, unsigned long, float, double, std::string>();
    return types;
}

template <class Predicate>
const ValueType* find(Predicate&& is_wanted) {
    const auto& types = value_types();
    const auto found =
        std::find_if(types.begin(), types.end(), [&](const auto& each) { return is_wanted(*each); });
    return found == types.end() ? nullptr : found->get();
}

} // namespace

const ValueType* find_value_type(const std::string& name) {
    return find([&](const ValueType& type) { return type.name == name; });
}

const ValueType* find_value_type(const wire::Type& wanted) {
    return find([&](const ValueType& type) {
        return wire::is_assignable(type.type, wanted) && wire::is_assignable(wanted, type.type);
    });
}

const ValueType* find_content_type(Event& event) {
    return find([&](const ValueType& type) {
        opros_any sample = type.sample();
        return event.checkContentType(sample);
    });
}

TypeCheck check_typed(const opros_any& sample, const link::Port& peer, bool sends,
                      const std::string& convert) {
    auto check = check_type(sample, peer, sends, convert);
    if (check.error.empty() && check.value_has_time)
        check.error = fmt::format(
            "port '{}': OPRoS type {} begins with RTM's time, which does not cross in this engine: "
            "leave it out",
            peer.name, opros_any(sample).type());
    return check;
}

// ---- what check_type() asks

std::string why_not_archived(const opros_any& sample) {
    if (find_value_type(opros_any(sample).type())) return "";
    return "this engine gives only its name, and it is none of the known numbers, bool, std::string and "
           "vectors of these; list it in the file of TANDEM_OPROS_TYPES";
}

wire::Type type_of(const opros_any& sample, const wire::Type&) {
    const auto* known = find_value_type(opros_any(sample).type());
    if (known && known->type.kind == wire::Kind::structure) return known->type;
    wire::Type message;
    if (known) message.children.push_back(known->type);
    return message;
}

} // namespace tandem::adaptor
