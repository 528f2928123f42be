// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/typed/method_type.hpp"

#include "proxy/wire/signature_match.hpp"

#include <algorithm>
#include <cctype>

namespace tandem::adaptor {
namespace {

const MethodTypes& method_types() {
    static const MethodTypes types = [] {
        MethodTypes made;
        add_methods_of_one_argument(made);
        add_methods_of_two_arguments(made);
        add_users_methods(made);
        return made;
    }();
    return types;
}

bool is_same(const wire::Type& method, const wire::Type& operation) {
    return is_assignable(method, operation) && is_assignable(operation, method);
}

bool stands_for(const MethodType& method, const wire::Operation& operation) {
    if (method.result.has_value() != operation.result.has_value() ||
        method.arguments.size() != operation.arguments.size())
        return false;
    if (method.result && !is_same(*method.result, *operation.result)) return false;
    return std::equal(method.arguments.begin(), method.arguments.end(), operation.arguments.begin(),
                      [](const wire::Type& own, const wire::Argument& peers) {
                          return peers.direction == wire::Direction::in && is_same(own, peers.type);
                      });
}

} // namespace

const MethodType* find_method_type(const wire::Operation& operation) {
    const auto& types = method_types();
    const auto found = std::find_if(types.begin(), types.end(),
                                    [&](const MethodType& each) { return stands_for(each, operation); });
    return found == types.end() ? nullptr : &*found;
}

std::vector<std::string> names_of_methods(const std::string& operation, const PeerNames& names) {
    constexpr std::size_t prefix = sizeof "_get_" - 1;
    const std::string& own = names.own(operation);
    const bool is_attribute = operation.starts_with("_get_") || operation.starts_with("_set_");
    if (own != operation || !is_attribute || operation.size() == prefix) return {own};
    std::string camel = operation.substr(1, 3) + operation.substr(prefix);
    camel[3] = static_cast<char>(std::toupper(static_cast<unsigned char>(camel[3])));
    return {operation.substr(1), camel};
}

} // namespace tandem::adaptor
