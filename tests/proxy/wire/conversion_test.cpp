// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/conversion/conversion.hpp"
#include "tests/support/allocations.hpp"

#include <catch2/catch.hpp>

#include <numbers>
#include <random>

using namespace tandem::wire;
using Catch::Contains;

namespace {

using Payload = std::vector<std::byte>;

template <class Write>
Payload encoded(Write write) {
    Payload bytes;
    CdrWriter out(bytes);
    write(out);
    return bytes;
}

Conversion compiled(const char* from, const char* to, const char* request) {
    return {parse_signature(from), parse_signature(to), parse_conversion_request(request), true};
}

Payload converted(const char* from, const char* to, const char* request, const Payload& message) {
    auto conversion = compiled(from, to, request);
    Payload bytes;
    CdrWriter out(bytes);
    INFO(conversion.error());
    REQUIRE(conversion.run(CdrReader(message), out));
    return bytes;
}

std::string refusal(const char* from, const char* to, const char* request, const Payload& message) {
    auto conversion = compiled(from, to, request);
    Payload bytes;
    CdrWriter out(bytes);
    CHECK_FALSE(conversion.run(CdrReader(message), out));
    return conversion.error();
}

} // namespace

TEST_CASE("numbers are widened, within structures and sequences, too") {
    const auto message = encoded([](CdrWriter& out) {
        out.put(1.5F);
        out.put(std::int16_t{-3});
        out.put(std::uint32_t{2});
        out.put(0.5F);
        out.put(0.25F);
    });
    const auto bytes = converted("f(n)af", "d(i)ad", "widen", message);
    CdrReader in(bytes);
    CHECK(in.get<double>() == 1.5);
    CHECK(in.get<std::int32_t>() == -3);
    CHECK(in.get_count(8) == 2);
    CHECK(in.get<double>() == 0.5);
    CHECK(in.get<double>() == 0.25);
    CHECK((in.ok() && in.remaining() == 0));
}

TEST_CASE("nothing is widened or narrowed without a request") {
    CHECK_THROWS_WITH(compiled("{a}f", "{a}d", "positions"),
                      Contains("field 'a' is float") && Contains("ask for widen"));
    CHECK_THROWS_WITH(compiled("{a}d", "{a}f", "widen"),
                      Contains("field 'a' is double") && Contains("ask for narrow"));
    CHECK_THROWS_WITH(compiled("{a}d{b}d", "{a}d", "widen"), Contains("field 'b'") && Contains("drop b"));
    CHECK_THROWS_WITH(compiled("{a}s", "{a}d", "narrow"), Contains("field 'a' is string here, double there"));
}

TEST_CASE("a value that does not fit the narrower type is an error of that message") {
    const auto number = [](double value) { return encoded([&](CdrWriter& out) { out.put(value); }); };
    const auto bytes = converted("d", "n", "narrow", number(-32768));
    CHECK(CdrReader(bytes).get<std::int16_t>() == -32768);
    CHECK_THAT(refusal("d", "n", "narrow", number(40000)), Contains("field '1' is 40000"));
    CHECK_THAT(refusal("d", "u", "narrow", number(-1)), Contains("cannot hold"));
    CHECK_THAT(refusal("d", "f", "narrow", number(1e300)), Contains("cannot hold"));
    CHECK_THAT(refusal("d", "i", "narrow", number(std::nan(""))), Contains("cannot hold"));
    const auto large = encoded([](CdrWriter& out) { out.put(~std::uint64_t{0}); });
    const auto same = converted("t", "t", "", large);
    CHECK(same == large);
}

TEST_CASE("fields are found by name, units are converted, defaults are filled in and fields are dropped") {
    const auto message = encoded([](CdrWriter& out) {
        out.put_string("left");
        out.put(180.0);
        out.put(2500.0);
        out.put(true);
    });
    const auto bytes =
        converted("{name}s{pose}({angle}d{x}d){valid}b", "{x}d{extra}i{heading}d{label}s",
                  "x: from pose.x mm->m; heading: from pose.angle deg->rad; extra: default -7; "
                  "label: from name; drop valid",
                  message);
    CdrReader in(bytes);
    CHECK(in.get<double>() == Approx(2.5));
    CHECK(in.get<std::int32_t>() == -7);
    CHECK(in.get<double>() == Approx(std::numbers::pi));
    CHECK(in.get_string() == "left");
    CHECK((in.ok() && in.remaining() == 0));
}

TEST_CASE("elements of a sequence of structures are reordered one by one") {
    const auto message = encoded([](CdrWriter& out) {
        out.put(std::uint32_t{3});
        for (int i = 0; i < 3; ++i) {
            out.put_string(std::string(static_cast<std::size_t>(i), 'x'));
            out.put(static_cast<double>(i));
        }
    });
    const auto bytes =
        converted("{marks}a({name}s{weight}d)", "{marks}a({weight}d{name}s)", "reorder", message);
    CdrReader in(bytes);
    CHECK(in.get_count(1) == 3);
    for (int i = 0; i < 3; ++i) {
        CHECK(in.get<double>() == i);
        CHECK(in.get_string().size() == static_cast<std::size_t>(i));
    }
    CHECK((in.ok() && in.remaining() == 0));
}

TEST_CASE("a number may be the count of a sequence, and a side without names is addressed by position") {
    const auto message = encoded([](CdrWriter& out) {
        out.put(std::uint32_t{5});
        out.put_block("abcde", 5, 1);
        out.put(std::int32_t{640});
    });
    const auto bytes = converted("ayi", "{size}t{width}q{pixels}ay",
                                 "narrow; size: count 1; width: from 2; pixels: from 1", message);
    CdrReader in(bytes);
    CHECK(in.get<std::uint64_t>() == 5);
    CHECK(in.get<std::uint16_t>() == 640);
    CHECK(in.get_count(1) == 5);
}

TEST_CASE("values beyond the receiver's bounds are refused with the field's name") {
    const auto text = encoded([](CdrWriter& out) { out.put_string("four"); });
    CHECK(converted("s", "s#4", "", text) == text);
    CHECK_THAT(refusal("s", "{label}s#3", "", text),
               Contains("field 'label' has 4 characters, at most 3 are allowed"));
    const auto numbers = encoded([](CdrWriter& out) {
        out.put(std::uint32_t{2});
        out.put(1.0);
        out.put(2.0);
    });
    CHECK(converted("ad", "a#2d", "", numbers) == numbers);
    CHECK_THAT(refusal("ad", "a#1d", "", numbers), Contains("has 2 elements, at most 1 are allowed"));
    const auto three = encoded([](CdrWriter& out) { out.put(std::int32_t{3}); });
    CHECK(converted("i", "e#4", "", three) == three);
    CHECK_THAT(refusal("i", "e#3", "", three), Contains("is 3, and the enumeration has 3 values"));
    const auto price = encoded([](CdrWriter& out) { out.put_string("-123.45"); });
    CHECK(converted("s", "F5,2", "", price) == price);
    CHECK_THAT(refusal("s", "F4,2", "", price), Contains("a decimal number of at most 4 digits"));
    CHECK_THAT(refusal("s", "F5,1", "", price), Contains("1 after the point"));
    CHECK_FALSE(refusal("s", "F5,2", "", text).empty());
}

TEST_CASE("a union crosses by its discriminator, and one without a case is refused") {
    const auto speed = encoded([](CdrWriter& out) {
        out.put(std::uint32_t{1});
        out.put(2.5);
    });
    CHECK(converted("<e#3;0=s;1=d>", "<e#3;0=s;1=d>", "", speed) == speed);
    const auto none = encoded([](CdrWriter& out) { out.put(std::uint32_t{9}); });
    CHECK_THAT(refusal("<e#3;0=s;1=d>", "<e#3;0=s;1=d>", "", none), Contains("discriminator 9"));
}

TEST_CASE("a request that is not understood is reported") {
    for (const auto& [text, what] : {std::pair{"widen; bigger", "'bigger'"},
                                     {"a: deg->m", "deg is a unit of angle"},
                                     {"a: parsec->m", "'parsec' is not a unit"},
                                     {": default 1", "expected a field"},
                                     {"a: * 0", "other than 0"},
                                     {"a: from", "the sender's field"},
                                     {"a: twice", "deg->rad"}})
        CHECK_THROWS_WITH(parse_conversion_request(text), Contains(what));
    CHECK(parse_conversion_request(" ; ").empty());
    CHECK_THROWS_WITH(compiled("{a}d", "{a}d", "b: deg->rad"), Contains("the receiver has no field 'b'"));
    CHECK_THROWS_WITH(compiled("{a}d", "{a}d", "a: from b"), Contains("the sender has no field 'b'"));
    CHECK_THROWS_WITH(compiled("{a}d", "{a}d{b}d", "reorder"), Contains("b: default VALUE"));
    CHECK_THROWS_WITH(compiled("{a}d{b}d", "{a}d", "reorder"), Contains("drop b"));
    CHECK_THROWS_WITH(compiled("{a}d", "{a}d{b}q", "b: default -1"), Contains("has no such value"));
    CHECK_THROWS_WITH(compiled("{a}i", "{a}i", "a: * 0.5"), Contains("ask for narrow"));
}

TEST_CASE("equal types need no conversion, and one of fixed size allocates nothing") {
    CHECK(compiled("(uu)ad", "(uu)ad", "").is_identity());
    CHECK_FALSE(compiled("ad", "a#9d", "").is_identity());
    CHECK_FALSE(compiled("d", "d", "1: deg->rad").is_identity());
    auto conversion = compiled("{a}f{b}({c}i{d}d)", "{d}d{a}d{c}x{e}s",
                               "widen; d: from b.d deg->rad; c: from b.c; e: default none");
    const auto message = encoded([](CdrWriter& out) {
        out.put(1.0F);
        out.put(std::int32_t{2});
        out.put(90.0);
    });
    Payload bytes(64);
    const long before = allocations();
    for (int i = 0; i < 100; ++i) {
        CdrWriter out(std::span<std::byte>{bytes});
        if (!conversion.run(CdrReader(message), out)) break;
    }
    CHECK(allocations() == before);
    CHECK(CdrReader(bytes).get<double>() == Approx(std::numbers::pi / 2));
}

TEST_CASE("a truncated or damaged message is refused or becomes another one, and nothing beyond it is read") {
    const char* from = "{a}f{s}s{l}a({x}d{n}s){u}<i;0=d;1=(sd);*=ay>{w}w{m}[3]n";
    const char* to = "{m}[3]i{l}a({n}s#40{x}f){u}<i;0=d;1=(sd);*=ay>{s}s#9{a}d{w}w#5{z}d";
    auto conversion = compiled(from, to, "narrow; reorder; z: default 1");
    const auto whole = encoded([](CdrWriter& out) {
        out.put(1.0F);
        out.put_string("text");
        out.put(std::uint32_t{2});
        for (int i = 0; i < 2; ++i) {
            out.put(1.0);
            out.put_string("name");
        }
        out.put(std::int32_t{1});
        out.put_string("case");
        out.put(4.0);
        out.put(std::uint32_t{0});
        for (int i = 0; i < 3; ++i) out.put(std::int16_t{7});
    });
    Payload bytes;
    CdrWriter out(bytes);
    REQUIRE(conversion.run(CdrReader(whole), out));
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const Payload cut(whole.begin(),
                          whole.begin() + static_cast<std::ptrdiff_t>(length)); // exact, for the sanitizer
        CdrWriter to_bytes(bytes);
        CHECK_FALSE(conversion.run(CdrReader(cut), to_bytes));
        CHECK_FALSE(conversion.error().empty());
    }
    std::mt19937 random(7);
    int refused = 0;
    for (int round = 0; round < 5000; ++round) {
        Payload damaged = whole;
        for (int flips = 1 + static_cast<int>(random() % 4); flips > 0; --flips)
            damaged[random() % damaged.size()] = static_cast<std::byte>(random());
        CdrWriter to_bytes(bytes);
        if (!conversion.run(CdrReader(damaged), to_bytes)) ++refused;
    }
    CHECK(refused > 100);
}

namespace {

Payload grid(std::int32_t width, std::int32_t height, const char* format, std::uint32_t count) {
    return encoded([&](CdrWriter& out) {
        out.put(width);
        out.put(height);
        out.put_string(format);
        const std::string cells(count, 'x');
        out.put_sequence(cells.data(), cells.size());
    });
}

constexpr const char* grid_type = "{width}i{height}i{format}s{cells}ay";

} // namespace

TEST_CASE("a field is the number of elements for each cell of a grid, if all have as many") {
    const char *to = "{cells}ay{bytes}i", *request = "bytes: count cells per width height; drop format";
    for (const auto& [width, height, count, each] :
         {std::tuple(4, 3, 36u, 3), {4, 3, 12u, 1}, {1, 1, 200u, 200}, {0, 0, 0u, 0}, {0, 7, 0u, 0}}) {
        const auto bytes = converted(grid_type, to, request, grid(width, height, "", count));
        CdrReader in(bytes);
        CHECK(in.get_sequence(1, 1).size() == count);
        CHECK(in.get<std::int32_t>() == each);
    }
    constexpr int most = std::numeric_limits<int>::max();
    for (const auto& [width, height, count] : {std::tuple(4, 3, 35u),
                                               {4, 3, 0u},
                                               {0, 3, 1u},
                                               {-4, -3, 36u},
                                               {-4, 0, 0u},
                                               {most, most, 36u},
                                               {-most, 1, 36u}})
        CHECK_THAT(
            refusal(grid_type, to, request, grid(width, height, "", count)),
            Contains("'bytes'") && Contains("'cells' has " + std::to_string(count)) &&
                Contains("width x height = " + std::to_string(width) + " x " + std::to_string(height)));
    CHECK_THAT(refusal(grid_type, "{cells}ay{bytes}y", std::string("narrow; ").append(request).c_str(),
                       grid(1, 1, "", 256)),
               Contains("'bytes' is 256"));
}

TEST_CASE("a sequence takes as many of the sender's elements as its other fields say") {
    const char *to = "{cells}ay", *request = "cells: from cells first width height; drop format";
    for (const auto& [width, height, count] :
         {std::tuple(4, 3, 12u), {4, 3, 100u}, {0, 3, 100u}, {0, 0, 0u}}) {
        const auto bytes = converted(grid_type, to, request, grid(width, height, "", count));
        CHECK(CdrReader(bytes).get_sequence(1, 1).size() == static_cast<std::size_t>(width * height));
    }
    for (const auto& [width, height] : {std::pair(4, 4), {-1, -1}, {1 << 30, 1 << 30}})
        CHECK_THAT(refusal(grid_type, to, request, grid(width, height, "", 15)),
                   Contains("'cells' has 15 elements") && Contains("width x height = "));
    // The bound applies to what is sent.
    const auto bounded = converted(grid_type, "{cells}a#12y", request, grid(4, 3, "", 100));
    CHECK(CdrReader(bounded).get_sequence(1, 1).size() == 12);
}

TEST_CASE("a message is refused for a word in its text or for one of its numbers") {
    const char *to = "{cells}ay",
               *request = "refuse format jp png; cells: from cells; drop width; drop height";
    for (const char* format : {"", "j", "pn", "RGB8"})
        CHECK_FALSE(converted(grid_type, to, request, grid(1, 1, format, 1)).empty());
    for (const char* format : {"JPEG", "image/png", "mJp"})
        CHECK_THAT(refusal(grid_type, to, request, grid(1, 1, format, 1)),
                   Contains("'format' is '" + std::string(format) + "'"));
    const char* numbers = "refuse width 3 -4; cells: from cells; drop format; drop height";
    CHECK_FALSE(converted(grid_type, to, numbers, grid(34, 1, "", 1)).empty());
    CHECK_THAT(refusal(grid_type, to, numbers, grid(-4, 1, "", 1)), Contains("'width' is '-4'"));
    CHECK_THAT(refusal("{f}e#9{x}u", "{x}u", "refuse f 8; x: from x", encoded([](CdrWriter& out) {
                           out.put(std::uint32_t{8});
                           out.put(std::uint32_t{1});
                       })),
               Contains("'f' is '8'"));
    const char* only = "refuse width unless 3 4; cells: from cells; drop format; drop height";
    CHECK_FALSE(converted(grid_type, to, only, grid(4, 1, "", 1)).empty());
    CHECK_THAT(refusal(grid_type, to, only, grid(5, 1, "", 1)),
               Contains("'width' is '5', expected one of 3, 4"));
    const char* raw = "refuse format unless rgb bgr; cells: from cells; drop width; drop height";
    CHECK_FALSE(converted(grid_type, to, raw, grid(1, 1, "BGR8", 1)).empty());
    CHECK_THAT(refusal(grid_type, to, raw, grid(1, 1, "", 1)), Contains("'format' is ''"));
}

TEST_CASE("fields used for counting or refusal must exist and have a suitable type") {
    const auto error = [](const char* to, const char* request) {
        try {
            compiled(grid_type, to, request);
        } catch (const ConversionError& what) {
            return std::string(what.what());
        }
        return std::string();
    };
    CHECK_THAT(error("{cells}ay", "cells: from cells first rows; drop format"), Contains("no field 'rows'"));
    CHECK_THAT(error("{cells}ay", "cells: from cells first format"), Contains("expected a whole number"));
    CHECK_THAT(error("{width}i", "width: from width first height"), Contains("needs a sequence"));
    CHECK_THAT(error("{cells}ay", "cells: from cells first"), Contains("expected fields of the sender"));
    CHECK_THAT(error("{n}i", "n: count cells per"), Contains("expected fields of the sender"));
    CHECK_THAT(error("{cells}ay", "refuse name jpeg; cells: from cells"), Contains("no field 'name'"));
    CHECK_THAT(error("{cells}ay", "refuse cells 1; cells: from cells"), Contains("needs a string"));
    CHECK_THAT(error("{cells}ay", "refuse format unless"), Contains("a word or number after 'refuse'"));
    CHECK_THAT(error("{cells}ay", "refuse format"), Contains("a word or number after 'refuse'"));
}
