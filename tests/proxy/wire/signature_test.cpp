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

TEST_CASE("a message is timed when more than the time is in it") {
    CHECK(is_timed("(uu)d"));
    CHECK_FALSE(is_timed("uud"));
    CHECK_FALSE(is_timed("(uu)"));
    CHECK_FALSE(is_timed("ad"));
}

TEST_CASE("what a message takes at most is known unless its type sets no bound") {
    const auto max_bytes = [](const char* signature) {
        return max_encoded_bytes(parse_signature(signature));
    };
    CHECK(max_bytes("(uu)d") >= 16);
    CHECK(max_bytes("(uu)d") < 64);
    CHECK(max_bytes("(uu)[1000]d") >= 8008);
    CHECK(max_bytes("[16777216][16777216][16777216]y") > 1e21);
    for (const char* unbounded : {"ad", "(uu)s", "[3](di(aq))", "w"}) CHECK(std::isinf(max_bytes(unbounded)));
}

TEST_CASE("an operation is arguments, colon, result") {
    CHECK(parse_operation_signature("ss:d") == OperationSignature{"ss", "d"});
    CHECK(parse_operation_signature(":ad") == OperationSignature{"", "ad"});
    CHECK(parse_operation_signature("i:") == OperationSignature{"i", ""});
    CHECK_THROWS_AS(parse_operation_signature("i"), SignatureError);
    CHECK_THROWS_AS(parse_operation_signature("i:d:d"), SignatureError);
}
