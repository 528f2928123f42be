// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/number.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/type.hpp"
#include "proxy/wire/type_text.hpp"

#include <catch2/catch.hpp>

using namespace tandem::wire;

TEST_CASE("a parsed signature is printed unchanged") {
    const auto text = GENERATE(as<std::string>{}, "d", "(uu)d", "ad", "aad", "(uu)(ddd)[3]dsa(sb)", "",
                               "bcynqiuxtfdsw", "DWevo", "s#80w#7a#10de#3", "F5,2", "<e#3;0=i;1,2=s;*=(dd)>",
                               "<c;-1=y>a<b;1=v>", "?{a valuetype}");
    CHECK(to_signature(parse_signature(text)) == text);
}

TEST_CASE("all parentheses around a whole message are dropped") {
    CHECK(to_signature(parse_signature("(sid)")) == "sid");
    CHECK(to_signature(parse_signature("((sid))")) == "sid");
    CHECK(to_signature(parse_signature("(s)(d)")) == "(s)(d)");
}

TEST_CASE("a malformed signature is refused with its text and the position") {
    const auto text = GENERATE(as<std::string>{}, "z", "()", "a[4]()", "a", "(d", "d)", "[0]d", "[3d", "[]d",
                               "[99999999999]d", "<", "<i>", "<i;0=d", "<d;0=i>", "<i;0,=d>", "<i;x=d>", "F5",
                               "F3,4", "F0,0", "F32,0", "s#", "s#99999999999", "{name", "{name}", "{name}z");
    CHECK_THROWS_AS(parse_signature(text), SignatureError);
    CHECK_THROWS_WITH(parse_signature(text), Catch::Contains("'" + text + "'"));
}

TEST_CASE("a difference to an any, a fixed or a reference says what stands for it") {
    const auto difference = [](const char* here, const char* there) {
        return first_difference(parse_signature(here), parse_signature(there), true);
    };
    CHECK(difference("{a}i{b}s", "{a}i{b}v") == "field 'b' is string here, any there; an any crosses as a "
                                                "structure of a string and a sequence of octets: "
                                                "change one of the two");
    CHECK(difference("{a}i{b}d", "{a}i{b}F5,2") ==
          "field 'b' is double here, fixed<5,2> there; a fixed crosses as a string: change one of the two");
}

TEST_CASE("labels of a union have any value of its discriminator") {
    for (const char* text : {"<x;-9223372036854775808=i;9223372036854775807=s>",
                             "<t;9223372036854775808=i;0,18446744073709551615=s;*=d>"})
        CHECK(to_signature(parse_signature(text)) == text);
    CHECK(parse_signature("<t;18446744073709551615=i>").children[0].children[1].labels ==
          std::vector<std::int64_t>{-1});
    for (const char* text :
         {"<t;18446744073709551616=i>", "<x;-9223372036854775809=i>", "<x;--1=i>", "<x;=i>"})
        CHECK_THROWS_AS(parse_signature(text), SignatureError);
}

TEST_CASE("the signature of an any has the ids of its types, which distinguish no types") {
    for (const char* text :
         {"", "d", "{IDL:M/S:1.0}({a}i)", "({a}i{b}d)", "{IDL:M/Row:1.0}a{IDL:M/S:1.0}({a}i)",
          "[2]{IDL:M/Mode:1.0 off,on}e#2",
          "{IDL:A:1.0}{IDL:M/U:1.0}<{IDL:M/Mode:1.0 off,on}e#2;0={x}i;*={y}{IDL:M/Row:1.0}ad>",
          "{IDL:M/Cam:1.0}o"})
        CHECK(to_any_signature(parse_any_signature(text)) == text);
    const auto type = parse_any_signature("{IDL:A:1.0}{IDL:M/S:1.0}({a}{IDL:B:1.0}i)");
    CHECK(type.ids == std::vector<std::string>{"IDL:A:1.0", "IDL:M/S:1.0"});
    CHECK(type.children[0].name == "a");
    CHECK(type == parse_any_signature("(i)"));
    CHECK(to_named_signature(type) == "{a}i");
    // In the form of a message: the list of its members.
    CHECK(to_any_signature(parse_any_signature("{a}i{b}d")) == "({a}i{b}d)");
}

TEST_CASE("a decimal number is a fixed if it needs no rounding") {
    const auto type = parse_signature("F5,2").children[0];
    for (const char* text : {"0", "123.45", "-123.45", "+0123.4500", ".5", "5.", "-0.00"})
        CHECK(is_fixed(text, type));
    for (const char* text : {"", ".", "-", "1234", "1.234", "1,5", "1e2", "0x1", " 1", "1.2.3", "--1"})
        CHECK_FALSE(is_fixed(text, type));
    CHECK(why_not_fixed("1.234", type) ==
          "is '1.234': expected a decimal number of at most 5 digits, 2 after the point");
}

TEST_CASE("a signature that would take much more memory than its text is refused with the limit") {
    const auto repeated = [](std::size_t count, const std::string& text) {
        std::string all;
        for (std::size_t i = 0; i < count; ++i) all += text;
        return all;
    };
    const auto reason_of = [](const std::string& text) {
        try {
            parse_any_signature(text);
        } catch (const SignatureError& error) {
            return error.reason();
        }
        return std::string();
    };
    CHECK(reason_of(repeated(20, "(" + repeated(4000, "d") + ")")) == "it has more than 65536 parts");
    CHECK(reason_of("<i;0" + repeated(65536, ",1") + "=d>") == "it has more than 65536 parts");
    CHECK(reason_of(repeated(33, "{a:}") + "d") == "a type has more than 32 ids");
    CHECK(reason_of(repeated(32, "{a:}") + "d").empty());
}

TEST_CASE("endless nesting is refused without recursion") {
    CHECK_THROWS_AS(parse_signature(std::string(1'000'000, 'a')), SignatureError);
    CHECK_THROWS_AS(parse_signature(std::string(1'000'000, '(')), SignatureError);
}

TEST_CASE("ports join when their signatures are equal up to RTM's leading time") {
    CHECK(match_signatures("ad", "ad") == SignatureMatch::equal);
    CHECK(match_signatures("(uu)ad", "(uu)ad") == SignatureMatch::equal);
    CHECK(match_signatures("(uu)ad", "ad") == SignatureMatch::strip_time);
    CHECK(match_signatures("ad", "(uu)ad") == SignatureMatch::add_time);
    CHECK(match_signatures("(uu)(ddd)", "ddd") == SignatureMatch::strip_time);
    CHECK(match_signatures("(sid)", "sid") == SignatureMatch::equal);
    CHECK(match_signatures("ad", "af") == SignatureMatch::mismatch);
    CHECK(match_signatures("(uu)ad", "(uu)af") == SignatureMatch::mismatch);
    CHECK(match_signatures("i", "d") == SignatureMatch::mismatch);
    CHECK(match_signatures("(uu)", "") == SignatureMatch::mismatch);
}

TEST_CASE("a message is timed if it contains more than the time") {
    CHECK(is_timed("(uu)d"));
    CHECK_FALSE(is_timed("uud"));
    CHECK_FALSE(is_timed("(uu)"));
    CHECK_FALSE(is_timed("ad"));
}

TEST_CASE("the maximum size of a message is known unless its type sets no bound") {
    const auto max_bytes = [](const char* signature) {
        return max_encoded_bytes(parse_signature(signature));
    };
    CHECK(max_bytes("(uu)d") >= 16);
    CHECK(max_bytes("(uu)d") < 64);
    CHECK(max_bytes("(uu)[1000]d") >= 8008);
    CHECK(max_bytes("[16777216][16777216][16777216]y") > 1e21);
    CHECK(max_bytes("a#10(ds#20)") < 1000);
    CHECK(max_bytes("<i;0=d;1=[9]d>F5,2DWw#3") < 200);
    for (const char* unbounded : {"ad", "(uu)s", "[3](di(aq))", "w", "v", "a#3s"})
        CHECK(std::isinf(max_bytes(unbounded)));
}

TEST_CASE("the length of a message is known if it has no strings, sequences or unions") {
    const auto bytes = [](const char* signature) { return fixed_bytes(parse_signature(signature)); };
    CHECK(bytes("") == 0);
    CHECK(bytes("d") == 8);
    CHECK(bytes("yd") == 16);
    CHECK(bytes("dy") == 9);
    CHECK(bytes("y(nb)[3]i") == 20);
    CHECK_FALSE(bytes("ds"));
    CHECK_FALSE(bytes("aid"));
}

TEST_CASE("values that cross in another form, or that are checked, are not plain") {
    const auto plain = [](const char* signature) { return is_plain(parse_signature(signature)); };
    for (const char* signature : {"", "bcynqiuxtfdD", "a(sn[3]db)"}) CHECK(plain(signature));
    for (const char* signature : {"W", "aw", "v", "(do)", "e"}) CHECK_FALSE(plain(signature));
}

TEST_CASE("names of members are kept, and do not distinguish types") {
    const std::string text = "{tm}({sec}u{nsec}u){shape}<e#2;0={radius}d;*={side}f>{points}a({x}d{y}d)";
    const Type type = parse_signature(text);
    CHECK(to_named_signature(type) == text);
    CHECK(to_signature(type) == "(uu)<e#2;0=d;*=f>a(dd)");
    CHECK(type == parse_signature("(uu)<e#2;0=d;*=f>a(dd)"));
    CHECK(is_timed(type));
    CHECK(to_named_signature(without_time(type)) == text.substr(text.find("{shape}")));
}

TEST_CASE("types that only one of the models has fit the type of their bytes") {
    const auto fit = [](const char* from, const char* to) {
        return is_assignable(parse_signature(from), parse_signature(to));
    };
    for (const auto& [foreign, own] : {std::pair{"e#3", "i"},
                                       {"e", "u"},
                                       {"F5,2", "s"},
                                       {"v", "(say)"},
                                       {"o", "s"},
                                       {"a#4d", "ad"},
                                       {"s#8", "s"},
                                       {"(ie#2)", "(ii)"},
                                       {"a(ne)", "a(ni)"}}) {
        INFO(foreign << " " << own);
        CHECK(fit(foreign, own));
        CHECK(fit(own, foreign));
    }
    for (const auto& [one, other] : {std::pair{"i", "u"},
                                     {"e", "x"},
                                     {"e", "d"},
                                     {"F5,2", "d"},
                                     {"v", "s"},
                                     {"f", "d"},
                                     {"[3]d", "[4]d"},
                                     {"<i;0=d>", "<i;1=d>"},
                                     {"<i;0=d>", "<i;0=f>"},
                                     {"?{valuetype}", "?{valuetype}"},
                                     {"c", "y"}}) {
        INFO(one << " " << other);
        CHECK_FALSE(fit(one, other));
    }
}

TEST_CASE("bytes need a check if the receiver's type allows less than the sender's") {
    const auto check = [](const char* from, const char* to) {
        return needs_check(parse_signature(from), parse_signature(to));
    };
    CHECK(check("ad", "a#4d"));
    CHECK(check("a#9d", "a#4d"));
    CHECK(check("i", "e#3"));
    CHECK(check("(ss)", "(ss#3)"));
    CHECK(check("s", "F5,2"));
    CHECK_FALSE(check("a#4d", "ad"));
    CHECK_FALSE(check("a#4d", "a#4d"));
    CHECK_FALSE(check("e#3", "i"));
    CHECK_FALSE(check("(uu)ad", "(uu)ad"));
}

TEST_CASE("the first member that differs is reported with what to do") {
    const auto difference = [](const char* here, const char* there, bool sent = true) {
        return first_difference(parse_signature(here), parse_signature(there), sent);
    };
    CHECK(difference("{a}d", "{a}d") == "");
    CHECK(difference("{velocity}({va}f{vx}d)", "{velocity}({va}d{vx}d)") ==
          "field 'velocity.va' is float here, double there: ask for widen");
    CHECK(difference("{a}({x}d{y}d)", "{a}({y}d{x}d)") ==
          "field 'a.x' stands here where 'y' stands there: ask for reorder");
    CHECK(difference("{a}({b}d)d", "{a}({b}f)d") ==
          "field 'a.b' is double here, float there: ask for narrow, or change one of the two");
    CHECK(difference("f", "d", false) ==
          "field 1 is float here, double there: ask for narrow, or change one of the two");
    CHECK(difference("i(sf)", "i(sd)") == "field 2.2 is float here, double there: ask for widen");
    CHECK(difference("ai", "ad") == "field 1[] is int32 here, double there: ask for widen");
    CHECK(difference("{a}d{b}d", "{b}d{a}d") ==
          "field 'a' stands here where 'b' stands there: ask for reorder");
    CHECK(difference("{a}d", "{a}d{b}s") ==
          "field 'b' is missing here and string there: ask for 'b: default VALUE'");
    CHECK(difference("{a}d{b}s#4", "{a}d") ==
          "field 'b' is string of at most 4 here and missing there: ask for 'drop b'");
    CHECK(difference("[3]f", "[4]f") ==
          "field 1 is array of 3 float here, array of 4 float there: change one of the two");
    CHECK(difference("<i;0=d>", "d") == "field 1 is union here, double there: change one of the two");
    CHECK(without_names("{a}i{b}({c}d):?{why}{d}s") == "i(d):?{why}s");
    CHECK(without_names("i{") == "i{");
    CHECK(first_unsupported(parse_signature("i({node}?{a valuetype})")) == "field 'node' is a valuetype");
}
