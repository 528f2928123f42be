// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/wide_text.hpp"

#include <cstdint>
#include <type_traits>

namespace tandem::command {

std::string to_utf8(std::wstring_view text) {
    std::string bytes;
    for (const wchar_t character : text) {
        const auto code = static_cast<std::uint32_t>(static_cast<std::make_unsigned_t<wchar_t>>(character));
        if (code < 0x80) {
            bytes += static_cast<char>(code);
        } else if (code < 0x800) {
            bytes += static_cast<char>(0xc0U | code >> 6U);
            bytes += static_cast<char>(0x80U | (code & 0x3fU));
        } else {
            bytes += static_cast<char>(0xe0U | (code >> 12U & 0x0fU));
            bytes += static_cast<char>(0x80U | (code >> 6U & 0x3fU));
            bytes += static_cast<char>(0x80U | (code & 0x3fU));
        }
    }
    return bytes;
}

std::string to_utf8(wchar_t character) {
    return to_utf8(std::wstring_view(&character, character == L'\0' ? 0 : 1));
}

std::optional<std::wstring> to_wide(std::string_view utf8) {
    std::wstring text;
    for (std::size_t i = 0; i < utf8.size();) {
        const auto first = static_cast<unsigned char>(utf8[i++]);
        const unsigned following = first < 0x80 ? 0 : first >> 5U == 6 ? 1 : first >> 4U == 14 ? 2 : 3;
        std::uint32_t code = following == 0 ? first : first & (following == 1 ? 0x1fU : 0x0fU);
        if (following == 3 || utf8.size() - i < following) return std::nullopt;
        for (unsigned n = 0; n < following; ++n, ++i) {
            const auto next = static_cast<unsigned char>(utf8[i]);
            if (next >> 6U != 2) return std::nullopt;
            code = code << 6U | (next & 0x3fU);
        }
        constexpr std::uint32_t least[] = {1, 0x80, 0x800}; // shorter forms exist for smaller codes
        if (code < least[following]) return std::nullopt;
        text += static_cast<wchar_t>(code);
    }
    return text;
}

} // namespace tandem::command
