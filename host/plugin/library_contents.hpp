// SPDX-License-Identifier: Apache-2.0
// Identifies a library from its ELF file, before any of its code runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>

namespace tandem::plugin {

/// What a library offers to a host, judged by its exported function.
enum class LibraryKind {
    opros_component, ///< exports getComponent
    rtc_module,      ///< exports rtc_init, or NAMEInit with the headers of RTM or functions of RTC::Manager
    device_api,      ///< exports GetAPI
    other,
};

/// Returns the kind for messages: "an OPRoS component", "an RTC module", ...
const char* kind_text(LibraryKind kind);

/// The two component models with public headers in this tree.
enum class ComponentModel { opros, rtm };

/// Returns the owner of the ELF notes in which the model's headers store their ABI number (TandemAbi.h).
const char* elf_note_name(ComponentModel model);

/// How a library uses the headers of one component model.
struct HeaderUse {
    std::set<std::uint32_t> abi_numbers; ///< ABI numbers in the library; several if its object files differ
    bool used = false;                   ///< true if it refers to functions of the model's classes
};

/// The result of read_contents().
struct LibraryContents {
    LibraryKind kind = LibraryKind::other;
    std::string entry;             ///< the exported function that determines `kind`; empty for other
    std::set<std::string> exports; ///< names of all exported C functions and objects
    HeaderUse opros, rtm;
    bool is_transport = false; ///< derives from RTM's classes of transports, so it may bring interface types
    bool trusted = false;      ///< part of Tandem: needs no probe (trusted_note.cpp)
};

/// Reads the library's dynamic symbols and notes, once for each version of the file. Does not map or run any of it. Throws
/// the errors of read_elf(). [any-thread]
LibraryContents read_contents(const std::filesystem::path& library);

/// Throws Error wrong_model unless the library is of this kind. The message names the actual kind and what loads such
/// a library.
void require_kind(const std::filesystem::path& library, const LibraryContents& contents, LibraryKind kind);

} // namespace tandem::plugin
