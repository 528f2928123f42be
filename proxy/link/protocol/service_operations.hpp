// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/wire/cdr.hpp"

namespace tandem::link {

/// Minimum bytes of an operation: two empty strings, the second one aligned to 4.
constexpr std::size_t min_operation_bytes = 13;

/// Encodes a list of operations as a part of a port table or service binding: count, then name and signature of each.
inline void put(wire::CdrWriter& out, const std::vector<ServiceOperation>& operations) {
    out.put(static_cast<std::uint32_t>(operations.size()));
    for (const auto& operation : operations) {
        out.put_string(operation.name);
        out.put_string(operation.signature);
    }
}

/// Decodes a list of operations. If the bytes are not such a list, the reader's ok() is false afterwards.
inline std::vector<ServiceOperation> get_service_operations(wire::CdrReader& in) {
    std::vector<ServiceOperation> operations(in.get_count(min_operation_bytes));
    for (auto& operation : operations) {
        operation.name = in.get_string();
        operation.signature = in.get_string();
    }
    return operations;
}

} // namespace tandem::link
