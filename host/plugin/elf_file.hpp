// SPDX-License-Identifier: Apache-2.0
// Reads dynamic symbols and notes of an ELF library as data (libelf). Nothing of the file is mapped for
// execution, so that a damaged or hostile library can be refused before its constructors run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tandem::plugin {

/// Result of read_elf().
struct ElfContents {
    std::set<std::string> defined; ///< C functions and objects that the library exports; no mangled names
    std::vector<std::string> undefined; ///< those it expects from other libraries
    std::map<std::string, std::set<std::uint32_t>>
        note_numbers; ///< numbers in its notes, by the note's owner
};

/// Reads a shared library for this machine. Throws Error: not_found, not_a_library, wrong_architecture or
/// damaged; the last also when the file ends before a segment that the dynamic linker would map, because an
/// access to that segment would end the process with SIGBUS. [any-thread]
ElfContents read_elf(const std::filesystem::path& library);

} // namespace tandem::plugin
