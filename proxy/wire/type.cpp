// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/type.hpp"

#include "proxy/wire/visit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

namespace tandem::wire {
namespace {

// Limits for signatures that another process wrote: parsing one must not exhaust the stack or the memory.
constexpr int max_depth = 32;
constexpr std::size_t max_members = 4096, max_parts = 65536, max_ids = 32;
constexpr std::uint32_t max_array = 1u << 24, max_bound = 0xffffffff, max_digits = 31;

/// Parses one signature by recursive descent.
class Parser {
  public:
    explicit Parser(std::string_view text, std::size_t position = 0) : text_(text), position_(position) {}

    Type parse_one() { return parse_member(0); }
    std::size_t position() const { return position_; }
    Type parse_message() {
        Type message;
        while (position_ < text_.size()) add_member(message, parse_member(0));
        return message;
    }

  private:
    Type parse_type(int depth) {
        if (depth > max_depth) fail("nesting is deeper than 32");
        if (++parts_ > max_parts) fail("it has more than 65536 parts");
        if (position_ == text_.size()) fail("it ends where a type is expected");
        const char code = text_[position_++];
        switch (code) {
        case 'a': {
            const auto bound = parse_bound();
            return Type{Kind::sequence, bound, {parse_member(depth + 1)}};
        }
        case '[': {
            const auto count = parse_array_count();
            return Type{Kind::array, count, {parse_member(depth + 1)}};
        }
        case '(':
            return parse_structure(depth);
        case '<':
            return parse_union(depth);
        case 'F':
            return parse_fixed();
        case '?':
            return Type{Kind::unsupported, 0, {}, 0, parse_name(), {}};
        case 's':
        case 'w':
        case 'e':
            return Type{static_cast<Kind>(code), parse_bound(), {}};
        default:
            break;
        }
        if (std::string_view("bcynqiuxtfdDWvo").find(code) == std::string_view::npos)
            fail(fmt::format("'{}' is not a type code", code));
        return Type{static_cast<Kind>(code), 0, {}};
    }

    Type parse_member(int depth) {
        std::string name;
        std::vector<std::string> ids;
        while (position_ < text_.size() && text_[position_] == '{') {
            std::string word = parse_name();
            if (word.find(':') == std::string::npos)
                name = std::move(word);
            else if (ids.size() < max_ids)
                ids.push_back(std::move(word));
            else
                fail("a type has more than 32 ids");
        }
        Type member = parse_type(depth);
        member.ids = std::move(ids);
        // The name of a type that cannot cross is the reason; the member's own name is put before it.
        if (member.kind == Kind::unsupported && !name.empty())
            member.name = "field '" + name + "' is " + member.name;
        else if (member.kind != Kind::unsupported)
            member.name = std::move(name);
        return member;
    }

    Type parse_structure(int depth) {
        Type structure;
        while (position_ < text_.size() && text_[position_] != ')')
            add_member(structure, parse_member(depth + 1));
        if (position_ == text_.size()) fail("')' is missing");
        if (structure.children.empty()) fail("a structure without members takes no bytes");
        ++position_;
        return structure;
    }

    // <DISCRIMINATOR;LABEL,LABEL=TYPE;*=TYPE>
    Type parse_union(int depth) {
        Type type{Kind::union_type, 0, {parse_member(depth + 1)}};
        const Kind kind = type.children.front().kind;
        if (std::string_view("bcnqiuxte").find(static_cast<char>(kind)) == std::string_view::npos)
            fail("a union's discriminator is an integer, a char, a boolean or an enumeration");
        while (skip_char(';')) {
            std::vector<std::int64_t> labels;
            if (!skip_char('*')) do
                    labels.push_back(parse_label());
                while (skip_char(','));
            if (!skip_char('=')) fail("expected '=' after the labels of a union's case");
            Type member = parse_member(depth + 1);
            member.labels = std::move(labels);
            add_member(type, std::move(member));
        }
        if (!skip_char('>')) fail("'>' is missing");
        if (type.children.size() == 1) fail("a union must have at least one case");
        return type;
    }

    Type parse_fixed() {
        Type type{Kind::fixed, parse_number(max_digits), {}};
        if (!skip_char(',')) fail("expected 'Fdigits,scale'");
        type.scale = parse_number(max_digits);
        if (type.count == 0 || type.scale > type.count) fail("a fixed has 1 to 31 digits");
        return type;
    }

    std::int64_t parse_label() {
        if (++parts_ > max_parts) fail("it has more than 65536 parts");
        const bool negative = skip_char('-');
        std::uint64_t value = 0; // from INT64_MIN to UINT64_MAX
        const auto* begin = text_.data() + position_;
        const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
        if (error != std::errc() || (negative && value > std::uint64_t{1} << 63)) fail("expected a number");
        position_ += static_cast<std::size_t>(end - begin);
        return static_cast<std::int64_t>(negative ? 0 - value : value);
    }

    std::string parse_name() {
        if (!skip_char('{')) return {};
        const auto end = text_.find('}', position_);
        if (end == std::string_view::npos) fail("'}' is missing");
        std::string name(text_.substr(position_, end - position_));
        position_ = end + 1;
        return name;
    }

    std::uint32_t parse_bound() { return skip_char('#') ? parse_number(max_bound) : 0; }

    std::uint32_t parse_number(std::uint32_t max) {
        std::uint64_t number = 0;
        if (position_ == text_.size() || text_[position_] < '0' || text_[position_] > '9')
            fail("expected a number");
        while (position_ < text_.size() && text_[position_] >= '0' && text_[position_] <= '9') {
            number = number * 10 + static_cast<std::uint64_t>(text_[position_++] - '0');
            if (number > max) fail(fmt::format("the number is above {}", max));
        }
        return static_cast<std::uint32_t>(number);
    }

    bool skip_char(char expected) {
        if (position_ == text_.size() || text_[position_] != expected) return false;
        ++position_;
        return true;
    }

    std::uint32_t parse_array_count() {
        const std::uint32_t count = parse_number(max_array);
        if (count == 0 || !skip_char(']')) fail("expected '[N]'");
        return count;
    }

    void add_member(Type& structure, Type member) {
        if (structure.children.size() == max_members) fail("it has more than 4096 members");
        structure.children.push_back(std::move(member));
    }

    [[noreturn]] void fail(std::string_view what) const {
        throw SignatureError(fmt::format("type signature '{}': {} at character {}", text_, what, position_),
                             std::string(what));
    }

    std::string_view text_;
    std::size_t position_, parts_ = 0; ///< parts: types, and labels of unions
};

/// Writes signatures with or without the names of members, and the ids of types.
class Printer {
  public:
    explicit Printer(bool names, bool ids = false) : names_(names), ids_(ids) {}

    std::string message(const Type& message) {
        for (const Type& member : message.children) append_member(member);
        return std::move(out_);
    }
    std::string type(const Type& type) {
        append(type);
        return std::move(out_);
    }

  private:
    void append_member(const Type& member) {
        if (names_ && !member.name.empty() && member.kind != Kind::unsupported)
            out_ += '{' + member.name + '}';
        append(member);
    }

    void append(const Type& type) {
        if (ids_)
            for (const auto& id : type.ids) out_ += '{' + id + '}';
        out_ += static_cast<char>(type.kind);
        switch (type.kind) {
        case Kind::structure:
            for (const Type& member : type.children) append_member(member);
            out_ += ')';
            return;
        case Kind::array:
            out_ += fmt::format("{}]", type.count);
            return append(type.children.front());
        case Kind::sequence:
            append_bound(type);
            return append(type.children.front());
        case Kind::union_type:
            return append_cases(type);
        case Kind::fixed:
            out_ += fmt::format("{},{}", type.count, type.scale);
            return;
        case Kind::unsupported:
            out_ += '{' + type.name + '}';
            return;
        default:
            return append_bound(type);
        }
    }

    void append_bound(const Type& type) {
        if (type.count != 0) out_ += fmt::format("#{}", type.count);
    }

    void append_cases(const Type& type) {
        append(type.children.front());
        for (std::size_t i = 1; i < type.children.size(); ++i) {
            const Type& member = type.children[i];
            append_labels(member.labels, type.children.front().kind);
            append_member(member);
        }
        out_ += '>';
    }

    void append_labels(const std::vector<std::int64_t>& labels, Kind discriminator) {
        out_ += labels.empty() ? ";*" : "";
        for (char separator = ';'; const std::int64_t label : labels)
            out_ += std::exchange(separator, ',') + label_text(discriminator, label);
        out_ += '=';
    }

    const bool names_, ids_;
    std::string out_;
};

} // namespace

Type parse_signature(std::string_view signature) {
    Type message = Parser(signature).parse_message();
    while (message.children.size() == 1 && message.children.front().kind == Kind::structure)
        message = Type(message.children.front());
    return message;
}

std::string to_any_signature(const Type& value) {
    const bool is_null = value.kind == Kind::structure && value.children.empty();
    return is_null ? "" : Printer(true, true).type(value);
}

Type parse_any_signature(std::string_view signature) {
    Type message = Parser(signature).parse_message();
    return message.children.size() == 1 ? Type(message.children.front()) : message;
}

std::string label_text(Kind discriminator, std::int64_t label) {
    return discriminator == Kind::uint64 ? std::to_string(static_cast<std::uint64_t>(label))
                                         : std::to_string(label);
}

Type parse_next_type(std::string_view text, std::size_t& position) {
    Parser parser(text, position);
    Type type = parser.parse_one();
    position = parser.position();
    return type;
}

std::string to_signature(const Type& message) { return Printer(false).message(message); }
std::string to_named_signature(const Type& message) { return Printer(true).message(message); }

std::size_t primitive_size(Kind kind) {
    return visit_number(kind, std::size_t{0}, [](auto number) { return sizeof number; });
}

std::size_t primitive_alignment(Kind kind) { return std::min<std::size_t>(primitive_size(kind), 8); }

bool contains(const Type& type, Kind kind) {
    return type.kind == kind || std::any_of(type.children.begin(), type.children.end(),
                                            [&](const Type& child) { return contains(child, kind); });
}

bool is_plain(const Type& type) {
    switch (type.kind) {
    case Kind::string:
    case Kind::sequence:
    case Kind::array:
    case Kind::structure:
    case Kind::union_type:
        return std::all_of(type.children.begin(), type.children.end(), is_plain);
    default:
        return primitive_size(type.kind) != 0 && type.kind != Kind::enumeration;
    }
}

namespace {

/// Returns the end of a value that begins at `position`.
std::optional<std::size_t> end_of(const Type& type, std::size_t position) {
    if (const std::size_t size = primitive_size(type.kind); size != 0) {
        const std::size_t alignment = primitive_alignment(type.kind);
        return (position + alignment - 1) / alignment * alignment + size;
    }
    std::optional<std::size_t> end = position;
    if (type.kind == Kind::array && type.count != 0) {
        const Type& element = type.children.front();
        const std::size_t size = primitive_size(element.kind);
        if (size == 0) return std::nullopt; // its elements may be padded: not worth the time
        return *end_of(element, position) + (type.count - 1) * size;
    }
    if (type.kind != Kind::structure) return std::nullopt;
    for (const Type& member : type.children)
        if (end) end = end_of(member, *end);
    return end;
}

} // namespace

std::optional<std::size_t> fixed_bytes(const Type& message) { return end_of(message, 0); }

double max_encoded_bytes(const Type& type) {
    // Before a primitive there are at most alignment - 1 bytes of padding.
    if (const std::size_t size = primitive_size(type.kind); size != 0)
        return static_cast<double>(size + primitive_alignment(type.kind) - 1);
    constexpr double count_bytes = 7, infinite = std::numeric_limits<double>::infinity();
    const double bound = type.count == 0 ? infinite : type.count;
    double all = 0, longest = 0;
    for (const Type& child : type.children) {
        all += max_encoded_bytes(child);
        if (&child != &type.children.front()) longest = std::max(longest, max_encoded_bytes(child));
    }
    switch (type.kind) {
    case Kind::structure:
        return all;
    case Kind::union_type:
        return max_encoded_bytes(type.children.front()) + longest;
    case Kind::array:
        return type.count * all;
    case Kind::sequence:
        return count_bytes + bound * all;
    case Kind::string:
        return count_bytes + bound + 1;
    case Kind::wide_string:
        return count_bytes + 2 * (bound + 1);
    case Kind::wide_character:
        return 3;
    case Kind::fixed:
        return count_bytes + type.count + 4; // sign, point, a zero before the point, the final NUL
    default:
        return infinite;
    }
}

} // namespace tandem::wire
