// SPDX-License-Identifier: Apache-2.0
// Which component model a library belongs to, before any of its code runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>

namespace tandem::plugin {

enum class Kind {
    opros_component, ///< exports getComponent
    rtc_module,      ///< exports NAMEInit or rtc_init and uses RTC::Manager
    device_api,      ///< exports GetAPI
    other,
};

/// "an OPRoS component", "an RTC module", ...
const char* kind_text(Kind kind);

enum class Model { opros, rtm };

/// The owner of the notes that the model's headers leave in a library (TandemAbi.h).
const char* note_owner(Model model);

/// What tells against which headers of a component model a library was built.
struct Headers {
    std::set<std::uint32_t> abi; ///< ABI numbers that these headers have left in it
    bool used = false;           ///< it refers to functions that only their classes have
};

struct Contents {
    Kind kind = Kind::other;
    std::string entry; ///< the function that says so; empty for other
    std::set<std::string> exports;
    Headers opros, rtm;
};

/// Reads the library's symbols and notes. Throws Error as read_elf() does.
Contents read_contents(const std::filesystem::path& library);

/// Throws Error wrong_model, with what the library is instead and which program takes it, unless it is of
/// this kind.
void require_kind(const std::filesystem::path& library, const Contents& contents, Kind kind);

} // namespace tandem::plugin
