// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace opros::archive {

/// The character in UTF-8; throws archive_format_exception when it is none (above 0x10ffff).
std::string to_utf8(wchar_t character);
/// The one character that the bytes are; throws archive_format_exception otherwise.
wchar_t from_utf8(const std::string& bytes);

} // namespace opros::archive
