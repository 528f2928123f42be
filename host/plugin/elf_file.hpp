// SPDX-License-Identifier: Apache-2.0
// Reads dynamic symbols and notes of an ELF library as data (libelf). Maps nothing for execution, so that a host can
// refuse a damaged or hostile library before its constructors run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tandem::plugin {

/// The result of read_elf().
struct ElfContents {
    std::set<std::string> defined; ///< C functions and objects that the library exports; no mangled names
    std::vector<std::string> undefined; ///< symbols expected from other libraries
    /// Numbers in the notes, by owner.
    std::map<std::string, std::set<std::uint32_t>> note_numbers;
};

/// Reads a shared library for this machine. Throws Error not_found, not_a_library, wrong_architecture or damaged. A
/// file is also damaged if it ends before a segment that the dynamic linker would map, because access to that segment
/// would end the process with SIGBUS. [any-thread]
ElfContents read_elf(const std::filesystem::path& library);

} // namespace tandem::plugin
