// SPDX-License-Identifier: Apache-2.0
// Whether code was built against this Tandem's headers: they leave an ABI number in it (TandemAbi.h).
#pragma once

#include "host/plugin/library_contents.hpp"

namespace tandem::plugin {

/// Throws Error abi_mismatch, with what to do, if the model's headers have left another number than expected in
/// the library, or none although it refers to their classes. What does not come from such headers passes.
void require_abi(const std::filesystem::path& library, const LibraryContents& contents, ComponentModel model,
                 std::uint32_t expected);

/// Throws the same if the program or a library that is loaded has another number than expected; with `plugin`,
/// one that has come with it, or since. [any-thread]
void require_abi_of_process(ComponentModel model, std::uint32_t expected,
                            const std::filesystem::path& plugin = {});

} // namespace tandem::plugin
