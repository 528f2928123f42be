// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/type.hpp"

#include <fmt/format.h>

#include <limits>
#include <numeric>

namespace tandem::wire {
namespace {

// Bounds for signatures that another process wrote: parsing one must not exhaust the stack or the memory.
constexpr int max_depth = 32;
constexpr std::size_t max_members = 4096;
constexpr std::uint32_t max_array = 1u << 24;

/// Recursive descent over one signature.
class Parser {
  public:
    explicit Parser(std::string_view text) : text_(text) {}

    Type parse_message() {
        Type message;
        while (position_ < text_.size()) add_member(message, parse_type(0));
        return message;
    }

  private:
    Type parse_type(int depth) {
        if (depth > max_depth) fail("nesting is deeper than 32");
        if (position_ == text_.size()) fail("it ends where a type was expected");
        const char code = text_[position_++];
        switch (code) {
        case 'a':
            return Type{Kind::sequence, 0, {parse_type(depth + 1)}};
        case '[': {
            const auto count = parse_array_count();
            return Type{Kind::array, count, {parse_type(depth + 1)}};
        }
        case '(':
            return parse_structure(depth);
        default:
            break;
        }
        if (std::string_view("bcynqiuxtfdsw").find(code) == std::string_view::npos)
            fail(fmt::format("'{}' is not a type code", code));
        return Type{static_cast<Kind>(code), 0, {}};
    }

    Type parse_structure(int depth) {
        Type structure;
        while (position_ < text_.size() && text_[position_] != ')')
            add_member(structure, parse_type(depth + 1));
        if (position_ == text_.size()) fail("')' is missing");
        if (structure.children.empty()) fail("a structure without members takes no bytes");
        ++position_;
        return structure;
    }

    std::uint32_t parse_array_count() {
        std::uint32_t count = 0;
        while (position_ < text_.size() && text_[position_] >= '0' && text_[position_] <= '9') {
            count = count * 10 + static_cast<std::uint32_t>(text_[position_++] - '0');
            if (count > max_array) fail("the array is too long");
        }
        if (count == 0 || position_ == text_.size() || text_[position_++] != ']') fail("'[N]' was expected");
        return count;
    }

    void add_member(Type& structure, Type member) {
        if (structure.children.size() == max_members) fail("it has more than 4096 members");
        structure.children.push_back(std::move(member));
    }

    [[noreturn]] void fail(std::string_view what) const {
        throw SignatureError(fmt::format("type signature '{}': {} at character {}", text_, what, position_));
    }

    std::string_view text_;
    std::size_t position_ = 0;
};

void append(std::string& out, const Type& type) {
    switch (type.kind) {
    case Kind::structure:
        out += '(';
        for (const Type& member : type.children) append(out, member);
        out += ')';
        return;
    case Kind::sequence:
        out += 'a';
        break;
    case Kind::array:
        out += fmt::format("[{}]", type.count);
        break;
    default:
        out += static_cast<char>(type.kind);
        return;
    }
    append(out, type.children.front());
}

} // namespace

Type parse_signature(std::string_view signature) {
    Type message = Parser(signature).parse_message();
    while (message.children.size() == 1 && message.children.front().kind == Kind::structure)
        message = Type(message.children.front());
    return message;
}

std::string to_signature(const Type& message) {
    std::string out;
    for (const Type& member : message.children) append(out, member);
    return out;
}

std::size_t primitive_size(Kind kind) {
    switch (kind) {
    case Kind::boolean:
    case Kind::character:
    case Kind::octet:
        return 1;
    case Kind::int16:
    case Kind::uint16:
        return 2;
    case Kind::int32:
    case Kind::uint32:
    case Kind::float32:
        return 4;
    case Kind::int64:
    case Kind::uint64:
    case Kind::float64:
        return 8;
    default:
        return 0;
    }
}

double max_encoded_bytes(const Type& type) {
    const std::size_t size = primitive_size(type.kind);
    // Before a primitive there are at most size - 1 bytes of padding.
    if (size != 0) return static_cast<double>(2 * size - 1);
    if (type.kind == Kind::structure)
        return std::accumulate(
            type.children.begin(), type.children.end(), 0.0,
            [](double sum, const Type& member) { return sum + max_encoded_bytes(member); });
    if (type.kind == Kind::array) return type.count * max_encoded_bytes(type.children.front());
    return std::numeric_limits<double>::infinity();
}

} // namespace tandem::wire
