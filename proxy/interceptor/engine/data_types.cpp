// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/engine/data_types.hpp"

#include <rtm/InterfaceSignatures.h>

#ifdef TANDEM_RTM_PUBLIC_API
#include <dlfcn.h>
#include <link.h>

#include <vector>
#endif

namespace tandem::interceptor::engine {

#ifdef TANDEM_RTM_PUBLIC_API

namespace {

/// The symbol of the constant with the TypeCode of IDL:M/N/T:1.0, M::N::_tc_T, in the Itanium C++ ABI. Empty: no such id.
std::string typecode_symbol(const std::string& id) {
    const auto end = id.rfind(':');
    if (id.rfind("IDL:", 0) != 0 || end <= 4) return "";
    std::vector<std::string> names;
    std::string path = id.substr(4, end - 4);
    for (std::size_t at; (at = path.find('/')) != std::string::npos; path.erase(0, at + 1))
        names.push_back(path.substr(0, at));
    if (!names.empty() && names.front().find('.') != std::string::npos)
        names.erase(names.begin()); // the prefix
    names.push_back("_tc_" + path);
    if (names.size() == 1) return names.front(); // of no module: not mangled
    std::string symbol = "_ZN";
    for (const auto& name : names) symbol += std::to_string(name.size()) + name;
    return symbol + "E";
}

/// In the libraries in the order in which they were loaded: RTCs are loaded so that their symbols are nobody else's.
CORBA::TypeCode_ptr find_typecode(const std::string& symbol) {
    std::vector<std::string> libraries;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* names) {
            static_cast<std::vector<std::string>*>(names)->emplace_back(info->dlpi_name);
            return 0;
        },
        &libraries);
    for (const auto& name : libraries) {
        void* library = dlopen(name.empty() ? nullptr : name.c_str(), RTLD_LAZY | RTLD_NOLOAD);
        if (!library) continue;
        auto* constant = static_cast<const CORBA::TypeCode_ptr*>(dlsym(library, symbol.c_str()));
        dlclose(library);
        if (constant && !CORBA::is_nil(*constant)) return *constant;
    }
    return CORBA::TypeCode::_nil();
}

} // namespace

std::string data_type_signature(const std::string& repository_id) {
    std::string signature = RTC::InterfaceSignatures::type(repository_id);
    const std::string symbol = signature.empty() ? typecode_symbol(repository_id) : "";
    if (symbol.empty()) return signature;
    if (const auto code = find_typecode(symbol); !CORBA::is_nil(code)) {
        RTC::InterfaceSignatures::addType(repository_id.c_str(), code);
        signature = RTC::InterfaceSignatures::type(repository_id);
    }
    return signature;
}

#else

std::string data_type_signature(const std::string& repository_id) {
    return RTC::InterfaceSignatures::type(repository_id);
}

#endif

} // namespace tandem::interceptor::engine
