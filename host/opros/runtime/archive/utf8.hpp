// SPDX-License-Identifier: Apache-2.0
// UTF-8 (RFC 3629) of single characters, for the archives that write wchar_t so.
#pragma once

#include <string>

namespace opros::archive {

/// 1 to 4 bytes. Throws archive_format_exception for a value above 0x10ffff, which is no character.
std::string to_utf8(wchar_t character);
/// Throws archive_format_exception unless the bytes are exactly one character in its shortest form.
wchar_t from_utf8(const std::string& bytes);

} // namespace opros::archive
