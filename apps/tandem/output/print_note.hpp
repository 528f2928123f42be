// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/text/printable.hpp"

#include <fmt/core.h>

#include <cstdio>
#include <string>

namespace tandem::command {

/// Writes a message for people to standard error, with '?' for control characters except newlines and tabs. Unlike fmt::print(), it does not throw if writing fails, for example
/// on a full disk: the program's work is more important.
inline void print_note(const std::string& text) {
    std::fputs(text::printable_text(text).c_str(), stderr);
    std::fflush(stderr);
}

/// Formats the message with fmt.
template <typename... Args>
void print_note(fmt::format_string<Args...> text, Args&&... args) {
    print_note(fmt::vformat(text, fmt::make_format_args(args...)));
}

} // namespace tandem::command
