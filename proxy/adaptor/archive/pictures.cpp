// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/archive/pictures.hpp"

#include "proxy/wire/conversion/conversion.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::adaptor {
namespace {

using wire::Kind;
using wire::Type;

// The most that RawImage.h itself accepts.
constexpr std::int32_t max_pixel_bytes = 64;
constexpr std::uint64_t max_bytes = 1u << 30;

bool is_picture(const Type& type) {
    struct Member {
        std::string_view name;
        Kind kind;
    };
    constexpr Member members[] = {{"raw", Kind::string},
                                  {"width", Kind::int32},
                                  {"height", Kind::int32},
                                  {"pixelByte", Kind::int32},
                                  {"size", Kind::uint64}};
    return type.kind == Kind::structure && type.children.size() == std::size(members) + 1 &&
           std::equal(std::begin(members), std::end(members), type.children.begin(),
                      [](const Member& member, const Type& child) {
                          return child.name == member.name && child.kind == member.kind;
                      }) &&
           type.children.back().kind == Kind::sequence &&
           type.children.back().children.front().kind == Kind::octet;
}

bool holds_picture(const Type& type) {
    return is_picture(type) || std::any_of(type.children.begin(), type.children.end(), holds_picture);
}

std::string check_picture(wire::CdrReader& in, PictureBytes bytes) {
    in.get_string();
    const auto width = in.get<std::int32_t>(), height = in.get<std::int32_t>(),
               pixel_bytes = in.get<std::int32_t>();
    const auto size = in.get<std::uint64_t>();
    const std::uint64_t count = in.get_sequence(1, 1).size();
    const auto error = [&](std::string_view expected) {
        return fmt::format("a picture of {} x {} pixels of {} bytes has {} bytes and the size {}: {}", width,
                           height, pixel_bytes, count, size, expected);
    };
    if (!in.ok()) return ""; // the archive that reads the value reports this
    if (width < 0 || height < 0 || pixel_bytes < 0 || pixel_bytes > max_pixel_bytes || count > max_bytes)
        return error("expected sizes from 0, at most 64 bytes per pixel, and at most 1 GiB");
    const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    // More pixels than bytes are refused first: their product may be more than 64 bits hold.
    if (pixels > count) return error("at least one byte per pixel is expected");
    const std::uint64_t expected = pixels * static_cast<std::uint64_t>(pixel_bytes);
    const bool fits =
        bytes == PictureBytes::exact ? expected == count && expected == size : expected <= count;
    if (!fits || (pixels > 0 && pixel_bytes == 0))
        return error(fmt::format("expected {} bytes, at least one per pixel", expected));
    return "";
}

std::string check(const Type& type, wire::CdrReader& in, PictureBytes bytes) {
    if (is_picture(type)) return check_picture(in, bytes);
    const bool has_elements = type.kind == Kind::sequence || type.kind == Kind::array;
    if ((!has_elements && type.kind != Kind::structure) || !holds_picture(type)) {
        wire::skip_value(type, in);
        return "";
    }
    if (!has_elements) {
        for (const Type& member : type.children)
            if (auto error = check(member, in, bytes); !error.empty()) return error;
        return "";
    }
    std::uint32_t count = type.kind == Kind::array ? type.count : in.get_count(1);
    for (; count > 0 && in.ok(); --count)
        if (auto error = check(type.children.front(), in, bytes); !error.empty()) return error;
    return "";
}

} // namespace

std::optional<Type> pictures_in(Type type) {
    return holds_picture(type) ? std::optional(std::move(type)) : std::nullopt;
}

std::string picture_error(const Type& message, wire::CdrReader in, PictureBytes bytes) {
    return check(message, in, bytes);
}

} // namespace tandem::adaptor
