// SPDX-License-Identifier: Apache-2.0
// Internal to host/crash.
#pragma once

#include "host/crash/text_buffer.hpp"

#include <array>
#include <cstdint>

namespace tandem::crash {

/// Where in which file the code or data at an address lies.
struct CodeLocation {
    std::array<char, 1024> file{};   ///< of the library or program; empty: the address is in none
    std::uintptr_t offset = 0;       ///< in the file's own addresses, as addr2line and nm count
    std::array<char, 1024> symbol{}; ///< the function that the offset is in, mangled; empty: not known
    std::uintptr_t symbol_offset = 0;
};

/// Looks the address up in the loaded files, and its function in the file's symbol tables. [async-signal-safe]
CodeLocation locate(std::uintptr_t address);

} // namespace tandem::crash
