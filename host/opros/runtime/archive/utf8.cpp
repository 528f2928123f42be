// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/archive/utf8.hpp"

#include <archive/opros_archive_common.h>

#include <cwchar>

namespace opros::archive {

// RFC 3629: the highest bits of the first byte give the number of further bytes. Each of those has 6 bits.
std::string to_utf8(wchar_t character) {
    const auto code = static_cast<char32_t>(character);
    const auto tail = [code](int shift) { return static_cast<char>(0x80 | ((code >> shift) & 0x3f)); };
    if (code > 0x10ffff) throw archive_format_exception();
    if (code < 0x80) return {static_cast<char>(code)};
    if (code < 0x800) return {static_cast<char>(0xc0 | code >> 6), tail(0)};
    if (code < 0x10000) return {static_cast<char>(0xe0 | code >> 12), tail(6), tail(0)};
    return {static_cast<char>(0xf0 | code >> 18), tail(12), tail(6), tail(0)};
}

wchar_t from_utf8(const std::string& bytes) {
    if (bytes.empty() || bytes.size() > 4) throw archive_format_exception();
    const unsigned char first_masks[] = {0x7f, 0x1f, 0x0f, 0x07};
    unsigned long code = static_cast<unsigned char>(bytes[0]) & first_masks[bytes.size() - 1];
    for (std::size_t i = 1; i < bytes.size(); ++i)
        code = code << 6 | (static_cast<unsigned char>(bytes[i]) & 0x3fu);
    // Encoding the result again detects wrong lead bytes, wrong continuation bytes and overlong forms at once.
    if (code > 0x10ffff || to_utf8(static_cast<wchar_t>(code)) != bytes) throw archive_format_exception();
    return static_cast<wchar_t>(code);
}

} // namespace opros::archive
