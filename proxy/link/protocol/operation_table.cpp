// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/operation_table.hpp"

#include <algorithm>
#include <cctype>

namespace tandem::link {
namespace {

/// Returns `_get_x` for `get_x` and `getX`, or nothing if the name does not have this form.
std::vector<std::string> attribute_operations(std::string_view method) {
    if (!method.starts_with("get") && !method.starts_with("set")) return {};
    const std::string prefix = "_" + std::string(method.substr(0, 3)) + "_";
    std::string name(method.substr(3));
    if (name.starts_with('_')) return {prefix + name.substr(1)};
    if (name.empty() || !std::isupper(static_cast<unsigned char>(name[0]))) return {};
    std::string lower = name;
    lower[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
    return {prefix + lower, prefix + name};
}

KnownOperation parse_known_operation(const ServiceOperation& operation) {
    KnownOperation known{operation.name, {}, ""};
    try {
        known.types = wire::parse_operation(operation.signature);
        known.problem = wire::first_unsupported(known.types);
    } catch (const wire::SignatureError& error) {
        known.problem = error.what();
    }
    return known;
}

} // namespace

OperationTable::OperationTable(const std::vector<ServiceOperation>& operations) {
    for (const auto& operation : operations)
        operations_.emplace(operation.name, parse_known_operation(operation));
}

bool OperationTable::operator==(const OperationTable& other) const {
    return std::equal(begin(), end(), other.begin(), other.end(), [](const auto& a, const auto& b) {
        return a.first == b.first && a.second.types.signature == b.second.types.signature;
    });
}

const KnownOperation* OperationTable::find(std::string_view name) const {
    const auto found = operations_.find(name);
    return found == operations_.end() ? nullptr : &found->second;
}

const KnownOperation* OperationTable::find_for_method(std::string_view method) const {
    if (const auto* same = find(method)) return same;
    for (const auto& name : attribute_operations(method))
        if (const auto* attribute = find(name)) return attribute;
    return nullptr;
}

} // namespace tandem::link
