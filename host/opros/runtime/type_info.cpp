// SPDX-License-Identifier: Apache-2.0
#include <archive/opros_type_info.h>

#include <cstdlib>
#include <cxxabi.h>
#include <memory>

namespace opros {

std::string readable_name(const std::type_info& type) {
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> text(
        abi::__cxa_demangle(type.name(), nullptr, nullptr, &status), std::free);
    return status == 0 && text ? text.get() : type.name();
}

} // namespace opros
