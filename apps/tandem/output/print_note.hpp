// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <fmt/core.h>

#include <cstdio>
#include <string>

namespace tandem::command {

/// Writes a text for people to standard error. Unlike fmt::print() it does not throw if the text cannot be written, for instance because
/// the disk is full: what the program does is worth more.
inline void print_note(const std::string& text) {
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

/// The same for a format string of fmt and its arguments.
template <typename... Args>
void print_note(fmt::format_string<Args...> text, Args&&... args) {
    print_note(fmt::vformat(text, fmt::make_format_args(args...)));
}

} // namespace tandem::command
