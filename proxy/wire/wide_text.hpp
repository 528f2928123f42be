// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"

#include <string>
#include <string_view>

// Wide characters as omniORB writes them (GIOP 1.2, UTF-16). A character is the octet 2 and two bytes, the high one first.
// A string is its length in bytes, a byte order mark and units in the machine's order, or 0 if it is empty. Each character
// is one unit, as in omniORB: characters beyond U+FFFF cannot cross.
namespace tandem::wire {

/// Returns false, and writes nothing, if a character is beyond U+FFFF.
bool put_wide_string(CdrWriter& out, std::wstring_view text);
bool put_wide_character(CdrWriter& out, wchar_t character);

/// Replaces `text`. If the bytes are not a wide string, `text` becomes empty and in.ok() false.
void get_wide_string(CdrReader& in, std::wstring& text);
wchar_t get_wide_character(CdrReader& in);

} // namespace tandem::wire
