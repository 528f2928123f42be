// SPDX-License-Identifier: Apache-2.0
// The dynamic symbols and notes of an ELF library, read as data: nothing of the file is mapped for execution
// or run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace tandem::plugin {

struct ElfContents {
    std::set<std::string> defined;   ///< functions and objects that the library gives
    std::set<std::string> undefined; ///< those it expects of others
    std::map<std::string, std::set<std::uint32_t>> note_numbers; ///< its notes of one number each, by owner
};

/// Throws Error: not_found, not_a_library, damaged (also when the file ends before what is to be mapped,
/// which would end the process with SIGBUS), wrong_architecture.
ElfContents read_elf(const std::filesystem::path& library);

} // namespace tandem::plugin
