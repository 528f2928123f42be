// SPDX-License-Identifier: Apache-2.0
// Wide text of CORBA as UTF-8, which JSON has.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tandem::command {

/// Returns the text as UTF-8. Characters above U+FFFF do not occur in wide text of CORBA.
std::string to_utf8(std::wstring_view text);

/// Returns a single wide character as UTF-8, and NUL as an empty text: that is what is sent for one.
std::string to_utf8(wchar_t character);

/// Returns the text of UTF-8 bytes; nothing if they are not UTF-8, contain NUL or a character above U+FFFF.
std::optional<std::wstring> to_wide(std::string_view utf8);

} // namespace tandem::command
