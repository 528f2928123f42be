// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::command {

/// A library, by the beginning of the names that it defines.
struct SymbolLibrary {
    const char* symbol;     ///< prefix of its function names
    const char* pkg_config; ///< its pkg-config module; "" if it has none
    const char* library;    ///< the name after -l
};

/// Returns the library of an undefined symbol; nullptr if it is unknown.
const SymbolLibrary* find_library_of_symbol(const std::string& symbol);

} // namespace tandem::command
