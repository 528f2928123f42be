// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/operation.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace tandem::wire;

TEST_CASE("an operation is arguments, colon, result") {
    for (const std::string text : {"ss:d", ":ad", "i:", ":", "d>i&s:i", ">(dd)&a[3]y:(is)"})
        CHECK(parse_operation(text).signature == text);
}

TEST_CASE(
    "a request has the in and inout arguments, a reply the result and then the inout and out arguments") {
    const auto operation = parse_operation("d>i&(sb)>ad:x");
    CHECK(to_signature(operation.request) == "d(sb)");
    CHECK(to_signature(operation.reply) == "xi(sb)ad");
    CHECK_FALSE(operation.oneway);
    CHECK_FALSE(parse_operation("i:").result);
}

TEST_CASE("names of arguments are kept, and two sides need not agree on them") {
    const auto operation = parse_operation("{a}d>{b}(s{c}i):{value}x");
    CHECK(operation.signature == "d>(si):x");
    CHECK(operation.arguments[1].type.name == "b");
}

TEST_CASE("the text after the result tells whether there is a reply and which exceptions there are") {
    CHECK(parse_operation("s: oneway").oneway);
    const auto operation =
        parse_operation("s:i raises IDL:M/TooFast:1.0({speed}d{wheels}[4](sb)) IDL:M/Off:1.0()");
    CHECK(operation.signature == "s:i");
    REQUIRE(operation.exceptions.size() == 2);
    const auto* fast = operation.find_exception("IDL:M/TooFast:1.0");
    REQUIRE(fast);
    CHECK(to_named_signature(fast->fields) == "{speed}d{wheels}[4](sb)");
    CHECK(operation.find_exception("IDL:M/Off:1.0")->fields.children.empty());
    CHECK_FALSE(operation.find_exception("IDL:M/On:1.0"));
}

TEST_CASE("a malformed operation is refused with its text and the position") {
    const auto text = GENERATE(as<std::string>{}, "i", "i:d:d", "i:dd", ">:", "&", "d>:", "i: twoway",
                               "i: raises", "i: raises X", "i: raises X(", "i: raises X(z)", "i: raises X(d",
                               "i: raises X(d) ", "i:oneway", "i: oneway ");
    CAPTURE(text);
    CHECK_THROWS_AS(parse_operation(text), SignatureError);
}

TEST_CASE("an operation that cannot cross gives the reason") {
    const auto why = [](const char* signature) { return first_unsupported(parse_operation(signature)); };
    CHECK(why("{a}d>{b}({c}?{a tree}):") == "argument 'b': field 'c' is a tree");
    CHECK(why("{b}?{a tree}:") == "argument: field 'b' is a tree");
    CHECK(why("d:a?{a tree}") == "its result: a tree");
    CHECK(why("d: raises X({c}?{a tree})") == "exception X: field 'c' is a tree");
    CHECK(why("d:i").empty());
}

TEST_CASE("endless operations are refused") {
    std::string long_list(100'000, 'd');
    long_list += ':';
    CHECK_THROWS_AS(parse_operation(long_list), SignatureError);
    CHECK_THROWS_AS(parse_operation(std::string(100'000, '(')), SignatureError);
    std::string many = ":i raises";
    for (int i = 0; i < 1000; ++i) many += " X()";
    CHECK_THROWS_AS(parse_operation(many), SignatureError);
}

TEST_CASE("damaged operations are refused or read, and nothing else happens") {
    const std::string sound =
        "{a}d>{b}(s{c}i)&a#9[3]y:<e#2;0={r}d;*=f> raises IDL:M/X:1.0({v}d{w}[4](sb)) Y()";
    std::mt19937 random(7);
    int read = 0, refused = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::string text = sound;
        for (unsigned changes = 1 + random() % 3; changes > 0; --changes) switch (random() % 3) {
            case 0:
                text[random() % text.size()] = static_cast<char>(random() % 128);
                break;
            case 1:
                text.erase(random() % text.size(), 1 + random() % 4);
                break;
            default:
                text.insert(random() % text.size(), 1, sound[random() % sound.size()]);
            }
        try {
            parse_operation(text);
            ++read;
        } catch (const SignatureError&) {
            ++refused;
        }
    }
    CHECK(read > 0);
    CHECK(refused > 0);
}
