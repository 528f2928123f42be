// SPDX-License-Identifier: Apache-2.0
// Which component model a library belongs to, before any of its code runs.
#pragma once

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

struct Contents {
    Kind kind = Kind::other;
    std::string entry; ///< the function that says so; empty for other
    std::set<std::string> exports;
};

/// Reads the library's symbols. Throws Error as read_dynamic_symbols() does.
Contents read_contents(const std::filesystem::path& library);

/// Throws Error wrong_model, with what the library is instead and which program takes it, unless it is of
/// this kind.
void require_kind(const std::filesystem::path& library, const Contents& contents, Kind kind);

} // namespace tandem::plugin
