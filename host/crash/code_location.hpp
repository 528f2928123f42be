// SPDX-License-Identifier: Apache-2.0
// Internal to host/crash.
#pragma once

#include "host/crash/text_buffer.hpp"

#include <array>
#include <cstdint>

namespace tandem::crash {

/// The position of code or data in a file.
struct CodeLocation {
    std::array<char, 1024> file{};   ///< path of the library or program; empty: none contains the address
    std::uintptr_t offset = 0;       ///< in the file's own addresses, as in addr2line and nm
    std::array<char, 1024> symbol{}; ///< mangled name of the function at the offset; empty: unknown
    std::uintptr_t symbol_offset = 0;
};

/// Finds the address in the loaded files and its function in the file's symbol tables. [async-signal-safe]
CodeLocation locate(std::uintptr_t address);

} // namespace tandem::crash
