// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/port_table.hpp"
#include "proxy/wire/cdr.hpp"

namespace tandem::link {

/// How a list of operations lies in a port table and in a binding.
inline void put(wire::CdrWriter& out, const std::vector<ServiceOperation>& operations) {
    out.put(static_cast<std::uint32_t>(operations.size()));
    for (const auto& operation : operations) {
        out.put_string(operation.name);
        out.put_string(operation.signature);
    }
}

/// The reader's ok() says whether it was a list.
inline std::vector<ServiceOperation> get_service_operations(wire::CdrReader& in) {
    std::vector<ServiceOperation> operations(in.get_count(8));
    for (auto& operation : operations) {
        operation.name = in.get_string();
        operation.signature = in.get_string();
    }
    return operations;
}

} // namespace tandem::link
