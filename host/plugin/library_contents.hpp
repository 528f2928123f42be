// SPDX-License-Identifier: Apache-2.0
// What a library is, found out from its ELF file before any of its code runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>

namespace tandem::plugin {

/// What a library offers to a host, by the function that it exports.
enum class LibraryKind {
    opros_component, ///< exports getComponent
    rtc_module,      ///< exports NAMEInit or rtc_init and uses RTC::Manager
    device_api,      ///< exports GetAPI
    other,
};

/// For messages: "an OPRoS component", "an RTC module", ...
const char* kind_text(LibraryKind kind);

/// The two component models whose public headers this tree has.
enum class ComponentModel { opros, rtm };

/// Name of the owner of the ELF notes in which the model's headers put their ABI number (TandemAbi.h).
const char* elf_note_name(ComponentModel model);

/// How a library uses the headers of one component model.
struct HeaderUse {
    std::set<std::uint32_t> abi_numbers; ///< ABI numbers in it; several if its object files disagree
    bool used = false;                   ///< it refers to functions of their classes
};

/// Result of read_contents().
struct LibraryContents {
    LibraryKind kind = LibraryKind::other;
    std::string entry;             ///< the exported function that decides `kind`; empty for other
    std::set<std::string> exports; ///< names of all exported C functions and objects
    HeaderUse opros, rtm;
    bool trusted = false; ///< comes with Tandem: it needs no probe (trusted_note.cpp)
};

/// Reads the library's dynamic symbols and notes; maps and runs nothing of it. Throws Error as read_elf()
/// does. [any-thread]
LibraryContents read_contents(const std::filesystem::path& library);

/// Throws Error wrong_model unless the library is of this kind. The message says what it is instead and which
/// program loads it.
void require_kind(const std::filesystem::path& library, const LibraryContents& contents, LibraryKind kind);

} // namespace tandem::plugin
