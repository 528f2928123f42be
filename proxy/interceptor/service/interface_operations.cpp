// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/service/interface_operations.hpp"

#include "proxy/interceptor/corba/typecode.hpp"

#include <rtm/InterfaceSignatures.h>

namespace tandem::interceptor {

std::vector<link::ServiceOperation> operations_of(const std::string& interface) {
    std::vector<link::ServiceOperation> operations;
    if (const auto* known = RTC::InterfaceSignatures::find(interface))
        for (const auto& operation : *known)
            operations.push_back({operation.name, operation.arguments + ":" + operation.result});
    return operations;
}

bool is_named(std::string_view id, const std::string& interface) {
    // `IDL:prefix/M/I:1.0` is M::I, and I.
    const auto begin = id.find(':'), end = id.rfind(':');
    if (begin == end) return false;
    const std::string path = "/" + std::string(id.substr(begin + 1, end - begin - 1));
    const std::string guess = repository_id(interface); // `IDL:M/I:1.0`
    return path.ends_with("/" + guess.substr(guess.find(':') + 1, guess.rfind(':') - guess.find(':') - 1));
}

} // namespace tandem::interceptor
