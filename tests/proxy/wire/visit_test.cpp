// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/number.hpp"
#include "proxy/wire/type_text.hpp"
#include "proxy/wire/visit.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <typeindex>
#include <typeinfo>

using namespace tandem::wire;

namespace {

/// Returns the code of the kind whose function is called.
struct CodeOf {
    template <class T>
    char number(const Type&) const {
        static const std::map<std::type_index, char> codes{
            {typeid(bool), 'b'},          {typeid(signed char), 'c'},   {typeid(std::uint8_t), 'y'},
            {typeid(std::int16_t), 'n'},  {typeid(std::uint16_t), 'q'}, {typeid(std::int32_t), 'i'},
            {typeid(std::uint32_t), 'u'}, {typeid(std::int64_t), 'x'},  {typeid(std::uint64_t), 't'},
            {typeid(float), 'f'},         {typeid(double), 'd'},        {typeid(long double), 'D'}};
        return codes.at(typeid(T));
    }
    char enumeration(const Type&) const { return 'e'; }
    char wide_character(const Type&) const { return 'W'; }
    char string(const Type&) const { return 's'; }
    char wide_string(const Type&) const { return 'w'; }
    char fixed(const Type&) const { return 'F'; }
    char any(const Type&) const { return 'v'; }
    char object(const Type&) const { return 'o'; }
    char sequence(const Type&) const { return 'a'; }
    char array(const Type&) const { return '['; }
    char structure(const Type&) const { return '('; }
    char union_type(const Type&) const { return '<'; }
    char unsupported(const Type&) const { return '?'; }
};

/// One member of each kind.
constexpr const char* every_kind = "bcynqiuxtfdDWe#3sw#4F4,2voas[2]d(bd)<i;1=d;*=s>?{a reason}";

} // namespace

TEST_CASE("a visitor's function for the kind is called with the type") {
    const Type message = parse_signature(every_kind);
    REQUIRE(message.children.size() == 24);
    for (const Type& type : message.children)
        CHECK(visit(type.kind, CodeOf(), type) == static_cast<char>(type.kind));
}

TEST_CASE("each kind has a name and a size of its C++ type, or none") {
    // By the character of docs/wire_format.md; other kinds are not numbers.
    const std::map<char, std::size_t> sizes{{'b', 1}, {'c', 1},  {'y', 1}, {'n', 2}, {'q', 2},
                                            {'i', 4}, {'u', 4},  {'x', 8}, {'t', 8}, {'f', 4},
                                            {'d', 8}, {'D', 16}, {'e', 4}};
    for (const Type& type : parse_signature(every_kind).children) {
        const char code = static_cast<char>(type.kind);
        INFO(code);
        CHECK_FALSE(type_name(type).empty());
        const auto size = sizes.find(code);
        CHECK(primitive_size(type.kind) == (size == sizes.end() ? 0 : size->second));
        CHECK(is_number(type.kind) == (size != sizes.end()));
    }
}

TEST_CASE("the value of a discriminator is read by its kind") {
    std::vector<std::byte> bytes;
    CdrWriter out(bytes);
    out.put_bool(true);
    out.put(static_cast<signed char>(-3));
    out.put(std::int16_t{-300});
    out.put(std::uint64_t{1} << 40);
    CdrReader in(bytes);
    CHECK(get_integer(Kind::boolean, in) == 1);
    CHECK(get_integer(Kind::character, in) == -3);
    CHECK(get_integer(Kind::int16, in) == -300);
    CHECK(get_integer(Kind::uint64, in) == std::int64_t{1} << 40);
    CHECK(in.ok());
}
