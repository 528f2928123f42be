// SPDX-License-Identifier: Apache-2.0
// Internal to host/crash.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tandem::crash {

/// Builds a text without allocating memory and truncates it if it is too long. All functions are async-signal-safe.
class TextBuffer {
  public:
    TextBuffer& operator<<(std::string_view text);
    TextBuffer& operator<<(const char* text) { return *this << std::string_view(text ? text : "?"); }
    TextBuffer& decimal(std::int64_t number);
    TextBuffer& hexadecimal(std::uintptr_t number); ///< with the prefix 0x
    /// Appends the readable name of a C++ function, without parameters. Appends any other text unchanged.
    TextBuffer& symbol(const char* name);
    /// Appends the readable name of a type, from the result of std::type_info::name().
    TextBuffer& type(const char* name);

    /// Writes the text to standard error, in one piece if the kernel accepts it. Gives up if a pipe or terminal accepts
    /// nothing for a second.
    void write_to_stderr() const;

  private:
    TextBuffer& demangled(const char* name, int options);

    std::array<char, 16384> text_;
    std::size_t size_ = 0;
};

} // namespace tandem::crash
