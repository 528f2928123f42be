// SPDX-License-Identifier: Apache-2.0
// Whether code was built against this Tandem's headers: they leave an ABI number in it (TandemAbi.h).
#pragma once

#include "host/plugin/contents.hpp"

namespace tandem::plugin {

/// Throws Error another_abi, with what to do, if the model's headers have left another number than ours in
/// the library, or none although it refers to their classes. What does not come from such headers passes.
void require_abi(const std::filesystem::path& library, const Contents& contents, Model model,
                 std::uint32_t ours);

/// Throws the same if the program or a library that is loaded has another number than ours; with `plugin`,
/// one that has come with it, or since. [any-thread]
void require_abi_of_process(Model model, std::uint32_t ours, const std::filesystem::path& plugin = {});

} // namespace tandem::plugin
