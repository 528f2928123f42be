// SPDX-License-Identifier: Apache-2.0
// UTF-8 (RFC 3629) of single characters, for the archives that write wchar_t in UTF-8.
#pragma once

#include <string>

namespace opros::archive {

/// Encodes a character in 1 to 4 bytes. Throws archive_format_exception for a value above 0x10ffff.
std::string to_utf8(wchar_t character);
/// Decodes one character. Throws archive_format_exception unless the bytes are one character in its shortest form.
wchar_t from_utf8(const std::string& bytes);

} // namespace opros::archive
