// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/wide_text.hpp"

#include <algorithm>

namespace tandem::wire {
namespace {

constexpr std::uint16_t byte_order_mark = 0xfeff;
constexpr std::size_t unit_bytes = 2;

bool is_one_unit(wchar_t character) { return static_cast<std::uint32_t>(character) <= 0xffff; }

std::uint16_t swap_bytes(std::uint16_t unit) { return static_cast<std::uint16_t>(unit << 8U | unit >> 8U); }

std::uint16_t unit_at(std::span<const std::byte> bytes, std::size_t index) {
    std::uint16_t unit = 0;
    std::memcpy(&unit, bytes.data() + unit_bytes * index, unit_bytes);
    return unit;
}

void put_unit(CdrWriter& out, std::uint16_t unit) { out.put_block(&unit, unit_bytes, 1); }

} // namespace

bool put_wide_string(CdrWriter& out, std::wstring_view text) {
    if (!std::all_of(text.begin(), text.end(), is_one_unit)) return false;
    out.put(static_cast<std::uint32_t>(text.empty() ? 0 : unit_bytes * (text.size() + 1)));
    if (!text.empty()) put_unit(out, byte_order_mark);
    for (const wchar_t character : text) put_unit(out, static_cast<std::uint16_t>(character));
    return true;
}

bool put_wide_character(CdrWriter& out, wchar_t character) {
    if (!is_one_unit(character)) return false;
    out.put<std::uint8_t>(unit_bytes);
    put_unit(out, swap_bytes(static_cast<std::uint16_t>(character)));
    return true;
}

void get_wide_string(CdrReader& in, std::wstring& text) {
    text.clear();
    const auto bytes = in.get_count(1);
    const auto block = in.get_block(bytes, 1);
    if (bytes % unit_bytes != 0) in.fail();
    if (!in.ok()) return;
    const std::size_t units = block.size() / unit_bytes;
    const bool marked = units > 0 && unit_at(block, 0) == byte_order_mark;
    const bool swapped_mark = units > 0 && unit_at(block, 0) == swap_bytes(byte_order_mark);
    for (std::size_t i = marked || swapped_mark ? 1 : 0; i < units; ++i)
        text += static_cast<wchar_t>(marked ? unit_at(block, i) : swap_bytes(unit_at(block, i)));
}

wchar_t get_wide_character(CdrReader& in) {
    const auto bytes = in.get<std::uint8_t>();
    const auto block = in.get_block(bytes, 1);
    if (bytes != unit_bytes) in.fail();
    return in.ok() ? static_cast<wchar_t>(swap_bytes(unit_at(block, 0))) : L'\0';
}

} // namespace tandem::wire
