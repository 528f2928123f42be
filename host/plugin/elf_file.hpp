// SPDX-License-Identifier: Apache-2.0
// The dynamic symbols of an ELF library, read as data: nothing of the file is mapped for execution or run.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace tandem::plugin {

struct DynamicSymbols {
    std::set<std::string> defined;   ///< functions and objects that the library gives
    std::set<std::string> undefined; ///< those it expects of others
};

/// Throws Error: not_found, not_a_library, damaged (also when the file ends before what is to be mapped,
/// which would end the process with SIGBUS), wrong_architecture.
DynamicSymbols read_dynamic_symbols(const std::filesystem::path& library);

} // namespace tandem::plugin
