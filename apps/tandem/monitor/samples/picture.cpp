// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/samples/picture.hpp"

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/conversion/conversion.hpp"
#include "proxy/wire/number.hpp"

#include <fmt/format.h>

namespace tandem::monitor {
namespace {

using wire::Kind;
using wire::Type;

constexpr std::size_t max_format = 64; ///< bytes; a longer name is cut

bool is_integer(Kind kind) {
    return kind == Kind::int16 || kind == Kind::uint16 || kind == Kind::int32 || kind == Kind::uint32 ||
           kind == Kind::int64 || kind == Kind::uint64;
}

bool is_octets(const Type& type) {
    return type.kind == Kind::sequence && type.children.front().kind == Kind::octet;
}

struct Parts {
    int widths = 0, heights = 0, octets = 0;
};

void count_parts(const Type& type, Parts& parts) {
    for (const Type& member : type.children) {
        if (member.kind == Kind::structure) count_parts(member, parts);
        if (is_integer(member.kind) && member.name == "width") ++parts.widths;
        if (is_integer(member.kind) && member.name == "height") ++parts.heights;
        if (is_octets(member)) ++parts.octets;
    }
}

void read(const Type& type, wire::CdrReader& in, Picture& picture) {
    for (const Type& member : type.children) {
        if (member.kind == Kind::structure)
            read(member, in, picture);
        else if (is_integer(member.kind) && member.name == "width")
            picture.width = wire::get_integer(member.kind, in);
        else if (is_integer(member.kind) && member.name == "height")
            picture.height = wire::get_integer(member.kind, in);
        else if (member.kind == Kind::string && member.name == "format")
            picture.format = in.get_string().substr(0, max_format);
        else if (member.kind == Kind::enumeration && member.name == "format")
            picture.format = fmt::format("format {}", in.get<std::uint32_t>());
        else if (is_octets(member))
            picture.pixels = in.get_block(in.get_count(1), 1);
        else
            wire::skip_value(member, in);
    }
}

} // namespace

bool is_picture(const Type& message) {
    Parts parts;
    count_parts(message, parts);
    return parts.widths == 1 && parts.heights == 1 && parts.octets == 1;
}

std::optional<Picture> picture_in(const Type& message, std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    Picture picture;
    read(message, in, picture);
    return in.ok() ? std::optional(picture) : std::nullopt;
}

} // namespace tandem::monitor
