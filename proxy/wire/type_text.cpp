// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/type_text.hpp"

#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/visit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace tandem::wire {
namespace {

constexpr const char* number_name(bool) { return "boolean"; }
constexpr const char* number_name(signed char) { return "char"; }
constexpr const char* number_name(std::uint8_t) { return "octet"; }
constexpr const char* number_name(std::int16_t) { return "int16"; }
constexpr const char* number_name(std::uint16_t) { return "uint16"; }
constexpr const char* number_name(std::int32_t) { return "int32"; }
constexpr const char* number_name(std::uint32_t) { return "uint32"; }
constexpr const char* number_name(std::int64_t) { return "int64"; }
constexpr const char* number_name(std::uint64_t) { return "uint64"; }
constexpr const char* number_name(float) { return "float"; }
constexpr const char* number_name(double) { return "double"; }
constexpr const char* number_name(long double) { return "long double"; }

struct KindName {
    template <class T>
    const char* number() const {
        return number_name(T{});
    }
    const char* enumeration() const { return "enumeration"; }
    const char* wide_character() const { return "wide character"; }
    const char* string() const { return "string"; }
    const char* wide_string() const { return "wide string"; }
    const char* fixed() const { return "fixed"; }
    const char* any() const { return "any"; }
    const char* object() const { return "object reference"; }
    const char* sequence() const { return "sequence"; }
    const char* array() const { return "array"; }
    const char* structure() const { return "structure"; }
    const char* union_type() const { return "union"; }
    const char* unsupported() const { return "type that cannot cross"; }
};

/// Finds the first difference. `path_` leads to the members that are being compared.
class Comparison {
  public:
    /// `message` is the name of the only structure in the message, if there is just one.
    Comparison(bool sent, const std::string& message)
        : sent_(sent), path_(message), named_(!message.empty()) {}

    /// Returns the first member at another place on the other side, if both sides have the same names.
    std::string reordered(const Type& here, const Type& there) {
        if (here.kind != there.kind || here.children.size() != there.children.size()) return "";
        const bool structures = here.kind == Kind::structure && all_named(here) && all_named(there);
        const bool same_names = structures && std::all_of(here.children.begin(), here.children.end(),
                                                          [&](const Type& m) { return find(there, m.name); });
        for (std::size_t i = 0; i < here.children.size(); ++i) {
            const Type& mine = here.children[i];
            const Type& theirs = there.children[i];
            const bool moved = same_names && mine.name != theirs.name;
            auto text = descend(mine.name.empty() ? theirs.name : mine.name, i, [&] {
                return moved ? stands_elsewhere(theirs.name) : reordered(mine, theirs);
            });
            if (!text.empty()) return text;
        }
        return "";
    }

    std::string structures(const Type& here, const Type& there) {
        if (auto text = order_or_missing(here, there); !text.empty()) return text;
        const std::size_t common = std::min(here.children.size(), there.children.size());
        for (std::size_t i = 0; i < common; ++i) {
            const Type& mine = here.children[i];
            const Type& theirs = there.children[i];
            if (is_assignable(mine, theirs)) continue;
            return descend(mine.name.empty() ? theirs.name : mine.name, i,
                           [&] { return members(mine, theirs); });
        }
        if (here.children.size() == there.children.size()) return "";
        const bool more_here = here.children.size() > common;
        const Type& member = (more_here ? here : there).children[common];
        return descend(member.name, common, [&] { return missing(member, more_here); });
    }

  private:
    template <class Function>
    std::string descend(const std::string& name, std::size_t index, Function function) {
        const std::string outer = path_;
        path_ += (path_.empty() ? "" : ".") + (name.empty() ? std::to_string(index + 1) : name);
        named_ = named_ || !name.empty();
        std::string text = function();
        path_ = outer;
        return text;
    }
    std::string field() const { return named_ ? "field '" + path_ + "'" : "field " + path_; }

    static bool all_named(const Type& type) {
        return std::none_of(type.children.begin(), type.children.end(),
                            [](const Type& member) { return member.name.empty(); });
    }
    static const Type* find(const Type& type, const std::string& name) {
        const auto at = std::find_if(type.children.begin(), type.children.end(),
                                     [&](const Type& member) { return member.name == name; });
        return at == type.children.end() ? nullptr : &*at;
    }

    /// If both sides have names: returns a member that one side lacks or has at another place.
    std::string order_or_missing(const Type& here, const Type& there) {
        if (!all_named(here) || !all_named(there)) return "";
        const auto shared = [&](const Type& member) { return find(there, member.name) != nullptr; };
        if (std::none_of(here.children.begin(), here.children.end(), shared)) return "";
        for (std::size_t i = 0; i < here.children.size(); ++i)
            if (!shared(here.children[i]))
                return descend(here.children[i].name, i, [&] { return missing(here.children[i], true); });
        for (std::size_t i = 0; i < there.children.size(); ++i)
            if (!find(here, there.children[i].name))
                return descend(there.children[i].name, i, [&] { return missing(there.children[i], false); });
        for (std::size_t i = 0; i < std::min(here.children.size(), there.children.size()); ++i)
            if (here.children[i].name != there.children[i].name)
                return descend(here.children[i].name, i,
                               [&] { return stands_elsewhere(there.children[i].name); });
        return "";
    }

    std::string stands_elsewhere(const std::string& there) const {
        return fmt::format("{} stands here where '{}' stands there: ask for reorder", field(), there);
    }

    std::string missing(const Type& member, bool here_only) const {
        if (here_only == sent_)
            return fmt::format("{} is {} {} and missing {}: ask for 'drop {}'", field(), type_name(member),
                               here_only ? "here" : "there", here_only ? "there" : "here", path_);
        return fmt::format("{} is missing {} and {} {}: ask for '{}: default VALUE'", field(),
                           here_only ? "there" : "here", type_name(member), here_only ? "here" : "there",
                           path_);
    }

    std::string members(const Type& here, const Type& there) {
        if (here.kind == there.kind && here.kind == Kind::structure) return structures(here, there);
        const bool elements =
            here.kind == there.kind && (here.kind == Kind::sequence || here.kind == Kind::array);
        if (elements && (here.kind == Kind::sequence || here.count == there.count)) {
            path_ += "[]";
            return members(here.children.front(), there.children.front());
        }
        return fmt::format("{} is {} here, {} there{}{}", field(), type_name(here), type_name(there),
                           crossing_hint(here.kind, there.kind), remedy(here.kind, there.kind));
    }

    std::string remedy(Kind here, Kind there) const {
        const Kind from = sent_ ? here : there, to = sent_ ? there : here;
        if (can_widen(from, to)) return ": ask for widen";
        const bool numbers = primitive_size(from) != 0 && primitive_size(to) != 0;
        return numbers ? ": ask for narrow, or change one of the two" : ": change one of the two";
    }

    const bool sent_;
    std::string path_;
    bool named_;
};

int mantissa_bits(Kind kind) {
    switch (kind) {
    case Kind::float32:
        return 24;
    case Kind::float64:
        return 53;
    case Kind::long_double:
        return 64;
    default:
        return 0;
    }
}

bool is_signed(Kind kind) { return kind == Kind::int16 || kind == Kind::int32 || kind == Kind::int64; }

bool is_integer(Kind kind) {
    return kind == Kind::octet || kind == Kind::uint16 || kind == Kind::uint32 || kind == Kind::uint64 ||
           kind == Kind::enumeration || is_signed(kind);
}

} // namespace

std::string type_name(const Type& type) {
    std::string name = visit(type.kind, KindName());
    if (type.kind == Kind::array)
        return fmt::format("array of {} {}", type.count, type_name(type.children.front()));
    if (type.kind == Kind::fixed) return fmt::format("fixed<{},{}>", type.count, type.scale);
    if (type.kind == Kind::unsupported) return fmt::format("{} ({})", name, type.name);
    if (type.kind == Kind::sequence) name += " of " + type_name(type.children.front());
    if (type.count != 0 && type.kind != Kind::enumeration) name += fmt::format(" of at most {}", type.count);
    return name;
}

std::string crossing_hint(Kind one, Kind other) {
    const auto is_any_of = [&](Kind kind) { return one == kind || other == kind; };
    if (is_any_of(Kind::any)) return "; an any crosses as a structure of a string and a sequence of octets";
    if (is_any_of(Kind::fixed)) return "; a fixed crosses as a string";
    if (is_any_of(Kind::object)) return "; an object reference crosses as a string";
    return "";
}

std::string without_names(std::string_view signature) {
    std::string text;
    while (!signature.empty()) {
        const auto begin = signature.find('{'), end = signature.find('}', begin);
        if (end == std::string_view::npos) return text + std::string(signature);
        const bool is_reason = begin > 0 && signature[begin - 1] == '?';
        text += signature.substr(0, is_reason ? end + 1 : begin);
        signature.remove_prefix(end + 1);
    }
    return text;
}

std::string first_unsupported(const Type& type) {
    if (type.kind == Kind::unsupported) return type.name.empty() ? "it has no signature" : type.name;
    for (const Type& child : type.children)
        if (auto reason = first_unsupported(child); !reason.empty()) return reason;
    return "";
}

bool can_widen(Kind from, Kind to) {
    if (from == to) return false;
    const auto bits = [](Kind kind) { return static_cast<int>(8 * primitive_size(kind)); };
    if (mantissa_bits(to) != 0)
        return mantissa_bits(from) != 0
                   ? mantissa_bits(from) < mantissa_bits(to)
                   : is_integer(from) && bits(from) - (is_signed(from) ? 1 : 0) <= mantissa_bits(to);
    if (!is_integer(from) || !is_integer(to) || to == Kind::enumeration) return false;
    return is_signed(from) == is_signed(to) ? bits(from) < bits(to) : is_signed(to) && bits(from) < bits(to);
}

std::string first_difference(const Type& here, const Type& there, bool sent) {
    Comparison comparison(sent, here.name.empty() ? there.name : here.name);
    return is_assignable(here, there) ? comparison.reordered(here, there)
                                      : comparison.structures(here, there);
}

} // namespace tandem::wire
