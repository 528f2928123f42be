// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/type.hpp"

#include <catch2/catch.hpp>

using namespace tandem::wire;

TEST_CASE("a signature comes back as it was parsed") {
    const auto text =
        GENERATE(as<std::string>{}, "d", "(uu)d", "ad", "aad", "(uu)(ddd)[3]dsa(sb)", "", "bcynqiuxtfdsw");
    CHECK(to_signature(parse_signature(text)) == text);
}

TEST_CASE("the parentheses around a whole message are dropped, however many") {
    CHECK(to_signature(parse_signature("(sid)")) == "sid");
    CHECK(to_signature(parse_signature("((sid))")) == "sid");
    CHECK(to_signature(parse_signature("(s)(d)")) == "(s)(d)");
}

TEST_CASE("a malformed signature is refused with its text and the place") {
    const auto text = GENERATE(as<std::string>{}, "z", "()", "a[4]()", "a", "(d", "d)", "[0]d", "[3d", "[]d",
                               "[99999999999]d");
    CHECK_THROWS_AS(parse_signature(text), SignatureError);
    CHECK_THROWS_WITH(parse_signature(text), Catch::Contains("'" + text + "'"));
}

TEST_CASE("nesting without end is refused and not recursed into") {
    CHECK_THROWS_AS(parse_signature(std::string(1'000'000, 'a')), SignatureError);
    CHECK_THROWS_AS(parse_signature(std::string(1'000'000, '(')), SignatureError);
}

TEST_CASE("ports join when their signatures are equal up to RTM's leading time") {
    CHECK(match("ad", "ad") == Match::equal);
    CHECK(match("(uu)ad", "(uu)ad") == Match::equal);
    CHECK(match("(uu)ad", "ad") == Match::strip_time);
    CHECK(match("ad", "(uu)ad") == Match::add_time);
    CHECK(match("(uu)(ddd)", "ddd") == Match::strip_time);
    CHECK(match("(sid)", "sid") == Match::equal);
    CHECK(match("ad", "af") == Match::mismatch);
    CHECK(match("(uu)ad", "(uu)af") == Match::mismatch);
    CHECK(match("i", "d") == Match::mismatch);
    CHECK(match("(uu)", "") == Match::mismatch);
}

TEST_CASE("a message is timed when more than the time is in it") {
    CHECK(is_timed("(uu)d"));
    CHECK_FALSE(is_timed("uud"));
    CHECK_FALSE(is_timed("(uu)"));
    CHECK_FALSE(is_timed("ad"));
}

TEST_CASE("what a message takes at most is known unless its type sets no bound") {
    const auto most = [](const char* signature) { return most_bytes(parse_signature(signature)); };
    CHECK(most("(uu)d") >= 16);
    CHECK(most("(uu)d") < 64);
    CHECK(most("(uu)[1000]d") >= 8008);
    CHECK(most("[16777216][16777216][16777216]y") > 1e21);
    for (const char* unbounded : {"ad", "(uu)s", "[3](di(aq))", "w"}) CHECK(std::isinf(most(unbounded)));
}

TEST_CASE("an operation is arguments, colon, result") {
    CHECK(parse_operation("ss:d") == Operation{"ss", "d"});
    CHECK(parse_operation(":ad") == Operation{"", "ad"});
    CHECK(parse_operation("i:") == Operation{"i", ""});
    CHECK_THROWS_AS(parse_operation("i"), SignatureError);
    CHECK_THROWS_AS(parse_operation("i:d:d"), SignatureError);
}
