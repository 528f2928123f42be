// SPDX-License-Identifier: Apache-2.0
// Checks whether code was built against the headers of this Tandem. The public headers of each component model put an
// ABI number, an ELF note, into every object file that includes them (TandemAbi.h).
#pragma once

#include "host/plugin/library_contents.hpp"

namespace tandem::plugin {

/// Checks a library before it is loaded. Throws Error abi_mismatch, with advice, if the library has an ABI number
/// other than `expected` for this model, or if it has none but uses classes of the model's headers. A library that
/// does not use these headers passes. [any-thread]
void require_abi(const std::filesystem::path& library, const LibraryContents& contents, ComponentModel model,
                 std::uint32_t expected);

/// Checks the program and all loaded libraries, because a plugin may have loaded libraries built against other
/// headers. Throws Error abi_mismatch for the first one with another number. With `plugin`, checks only this library
/// and those loaded after it. [any-thread]
void require_abi_of_process(ComponentModel model, std::uint32_t expected,
                            const std::filesystem::path& plugin = {});

} // namespace tandem::plugin
