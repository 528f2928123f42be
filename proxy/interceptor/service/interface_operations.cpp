// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/service/interface_operations.hpp"

#include <rtm/InterfaceSignatures.h>

namespace tandem::interceptor {

std::vector<link::ServiceOperation> operations_of(const std::string& interface) {
    std::vector<link::ServiceOperation> operations;
    if (const auto* known = RTC::InterfaceSignatures::find(interface))
        for (const auto& operation : *known)
            operations.push_back({operation.name, operation.arguments + ":" + operation.result});
    return operations;
}

} // namespace tandem::interceptor
