// SPDX-License-Identifier: Apache-2.0
// Internal to host/crash.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tandem::crash {

/// Builds a text without allocating; what does not fit is cut off. All of it is async-signal-safe.
class TextBuffer {
  public:
    TextBuffer& operator<<(std::string_view text);
    TextBuffer& operator<<(const char* text) { return *this << std::string_view(text ? text : "?"); }
    TextBuffer& decimal(std::int64_t number);
    TextBuffer& hexadecimal(std::uintptr_t number); ///< with 0x
    /// A C++ function as a reader knows it, without its parameters; any other text unchanged.
    TextBuffer& symbol(const char* name);
    /// The same for a type, from what std::type_info::name() returns.
    TextBuffer& type(const char* name);

    /// Writes the text to standard error in one piece, as far as the kernel takes it so.
    void write_to_stderr() const;

  private:
    TextBuffer& demangled(const char* name, int options);

    std::array<char, 16384> text_;
    std::size_t size_ = 0;
};

} // namespace tandem::crash
