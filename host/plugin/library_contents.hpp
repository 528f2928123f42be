// SPDX-License-Identifier: Apache-2.0
// Which component model a library belongs to, before any of its code runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>

namespace tandem::plugin {

enum class LibraryKind {
    opros_component, ///< exports getComponent
    rtc_module,      ///< exports NAMEInit or rtc_init and uses RTC::Manager
    device_api,      ///< exports GetAPI
    other,
};

/// "an OPRoS component", "an RTC module", ...
const char* kind_text(LibraryKind kind);

enum class ComponentModel { opros, rtm };

/// The owner of the notes that the model's headers leave in a library (TandemAbi.h).
const char* note_owner(ComponentModel model);

/// What tells against which headers of a component model a library was built.
struct HeaderUse {
    std::set<std::uint32_t> abi_numbers; ///< ABI numbers that these headers have left in it
    bool used = false;                   ///< it refers to functions that only their classes have
};

struct LibraryContents {
    LibraryKind kind = LibraryKind::other;
    std::string entry; ///< the function that says so; empty for other
    std::set<std::string> exports;
    HeaderUse opros, rtm;
};

/// Reads the library's symbols and notes. Throws Error as read_elf() does.
LibraryContents read_contents(const std::filesystem::path& library);

/// Throws Error wrong_model, with what the library is instead and which program takes it, unless it is of
/// this kind.
void require_kind(const std::filesystem::path& library, const LibraryContents& contents, LibraryKind kind);

} // namespace tandem::plugin
