// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/stream/type_codes.hpp"

#include <boost/dll/runtime_symbol_info.hpp>
#include <boost/dll/shared_library.hpp>
#include <coil/stringutil.h>

#include <vector>

namespace tandem::command {
namespace {

// The mangled name (Itanium C++ ABI) of the TypeCode constant in omniidl's stubs: {RTC, TimedLong} becomes
// _ZN3RTC13_tc_TimedLongE, that is RTC::_tc_TimedLong. A name without a module is not mangled.
std::string symbol(const coil::vstring& names) {
    std::string mangled = "_ZN";
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string name = (i + 1 == names.size() ? "_tc_" : "") + names[i];
        mangled += std::to_string(name.size()) + name;
    }
    return names.size() == 1 ? "_tc_" + names[0] : mangled + "E";
}

} // namespace

void load_type_library(const std::filesystem::path& library) {
    // Never unloaded, because the TypeCodes are used until the program ends. rtld_global lets find_type_code() find them.
    static auto& loaded = *new std::vector<boost::dll::shared_library>;
    loaded.emplace_back(library, boost::dll::load_mode::rtld_lazy | boost::dll::load_mode::rtld_global);
}

// Repository ids have the form IDL:PREFIX/MODULE/NAME:VERSION (CORBA, Interface Repository).
CORBA::TypeCode_ptr find_type_code(const std::string& repository_id) {
    if (repository_id.compare(0, 4, "IDL:") != 0) return CORBA::TypeCode::_nil();
    coil::vstring names = coil::split(repository_id.substr(4, repository_id.rfind(':') - 4), "/", true);
    static const boost::dll::shared_library global_symbols(boost::dll::program_location());
    while (!names.empty()) {
        // The symbol is the variable that holds the TypeCode; the library's static initialisation has set it.
        if (const std::string constant = symbol(names); global_symbols.has(constant))
            return global_symbols.get<CORBA::TypeCode_ptr>(constant);
        if (names.front().find('.') == std::string::npos) break;
        names.erase(names.begin()); // a prefix such as omg.org is not in the C++ name
    }
    return CORBA::TypeCode::_nil();
}

} // namespace tandem::command
