// SPDX-License-Identifier: Apache-2.0
#include "host/text/printable.hpp"

#include <cstddef>

namespace tandem::text {
namespace {

/// Returns the number of bytes of the UTF-8 character at the beginning (RFC 3629, section 4); 0 if there is none.
std::size_t character_size(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    const std::size_t size = first < 0x80                     ? 1
                             : first >= 0xc2 && first < 0xe0  ? 2
                             : (first & 0xf0) == 0xe0         ? 3
                             : first >= 0xf0 && first <= 0xf4 ? 4
                                                              : 0;
    if (size == 0 || size > text.size()) return 0;
    for (std::size_t i = 1; i < size; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    const bool too_long = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
    const bool no_character = (first == 0xed && byte(1) > 0x9f) || (first == 0xf4 && byte(1) > 0x8f);
    return too_long || no_character ? 0 : size;
}

/// Returns whether a terminal may act on the character: C0, DEL, and C1, which U+0080 to U+009F encode.
bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character[0]);
    if (character.size() == 1) return first < ' ' || first == 0x7f;
    return first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
}

std::string printable(std::string_view text, std::string_view kept) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        const auto character = text.substr(0, size);
        if (size == 1 && kept.find(text[0]) != std::string_view::npos)
            out += text[0];
        else if (size == 0 || is_control(character))
            out += '?';
        else
            out += character;
        text.remove_prefix(size == 0 ? 1 : size);
    }
    return out;
}

} // namespace

std::string printable_line(std::string_view text) { return printable(text, ""); }

std::string printable_text(std::string_view text) { return printable(text, "\n\t"); }

} // namespace tandem::text
