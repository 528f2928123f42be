// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/format/utf8.hpp"

#include <cstddef>

namespace tandem::mcap {
namespace {

/// Length in bytes of the character that begins with `first`, and range of its second byte. 0: no character begins so.
struct Character {
    std::size_t length = 0;
    unsigned char lowest = 0x80, highest = 0xBF;
};

Character character(unsigned char first) {
    if (first < 0x80) return {1};
    if (first < 0xC2) return {}; // a continuation byte, or an overlong form
    if (first < 0xE0) return {2};
    if (first == 0xE0) return {3, 0xA0, 0xBF};
    if (first == 0xED) return {3, 0x80, 0x9F}; // higher values are surrogates
    if (first < 0xF0) return {3};
    if (first == 0xF0) return {4, 0x90, 0xBF};
    if (first == 0xF4) return {4, 0x80, 0x8F}; // higher values are above U+10FFFF
    return first < 0xF4 ? Character{4} : Character{};
}

} // namespace

bool is_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const auto next = character(static_cast<unsigned char>(text[at]));
        if (next.length == 0 || next.length > text.size() - at) return false;
        for (std::size_t i = 1; i < next.length; ++i) {
            const auto byte = static_cast<unsigned char>(text[at + i]);
            if (byte < (i == 1 ? next.lowest : 0x80) || byte > (i == 1 ? next.highest : 0xBF)) return false;
        }
        at += next.length;
    }
    return true;
}

} // namespace tandem::mcap
