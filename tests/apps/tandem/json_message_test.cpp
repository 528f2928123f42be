// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/observe/json_message.hpp"
#include "apps/tandem/observe/message_json.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <ctime>

using namespace tandem;
using namespace tandem::command;

namespace {

/// Encodes, and decodes what came out.
nlohmann::ordered_json there_and_back(const std::string& signature, const nlohmann::json& json) {
    const auto type = wire::parse_signature(signature);
    return message_to_json(type, json_to_message(type, json));
}

std::string refusal(const std::string& signature, const nlohmann::json& json) {
    try {
        json_to_message(wire::parse_signature(signature), json);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

const std::string all_kinds =
    "{flag}b{letter}c{small}y{i}n{j}q{k}i{l}u{m}x{n}t{f}f{d}d{colour}e#3{name}s{list}ad{bytes}ay"
    "{pair}[2]i{pose}({x}d{y}d){choice}<b;1={speed}d;*={text}s>";

} // namespace

TEST_CASE("the output of tandem echo is encoded back to the same message") {
    const nlohmann::json json{{"flag", true},
                              {"letter", "x"},
                              {"small", 255},
                              {"i", -32768},
                              {"j", 65535},
                              {"k", -2147483648LL},
                              {"l", 4294967295ULL},
                              {"m", INT64_MIN},
                              {"n", UINT64_MAX},
                              {"f", 0.5},
                              {"d", -1e300},
                              {"colour", 2},
                              {"name", "chair"},
                              {"list", {1.5, 2.5}},
                              {"bytes", "00ff7a"},
                              {"pair", {3, 4}},
                              {"pose", {{"x", 1.0}, {"y", -2.0}}},
                              {"choice", {{"case", 1}, {"speed", 0.25}}}};
    CHECK(nlohmann::json(there_and_back(all_kinds, json)) == json);
    CHECK(there_and_back("{bytes}ay", {{"bytes", {0, 255, 122}}})["bytes"] == "00ff7a");
    CHECK(there_and_back("{d}d", {{"d", "nan"}})["d"] == "nan");
    CHECK(there_and_back("{d}d", {{"d", "-inf"}})["d"] == "-inf");
    CHECK(there_and_back("di", nlohmann::json::array({1.5, 7})) == nlohmann::ordered_json::array({1.5, 7}));
}

TEST_CASE("absent members are zero or empty, and an absent RTM time is the current time") {
    const auto zeros =
        there_and_back("{flag}b{k}i{name}s{list}ad{pair}[2]i{pose}({x}d{y}d)", nlohmann::json::object());
    CHECK(nlohmann::json(zeros) == nlohmann::json({{"flag", false},
                                                   {"k", 0},
                                                   {"name", ""},
                                                   {"list", nlohmann::json::array()},
                                                   {"pair", {0, 0}},
                                                   {"pose", {{"x", 0.0}, {"y", 0.0}}}}));
    const auto timed = there_and_back("{tm}({sec}u{nsec}u){data}d", {{"data", 2.5}});
    CHECK(timed["data"] == 2.5);
    CHECK(std::abs(timed["tm"]["sec"].get<double>() - static_cast<double>(std::time(nullptr))) < 100);
    CHECK(there_and_back("{tm}({sec}u{nsec}u){data}d", {{"tm", {{"sec", 7}}}})["tm"]["sec"] == 7);
}

TEST_CASE("a value that does not fit its type is refused with the name of the member") {
    CHECK(refusal("{k}i{pose}({x}d{y}d)", {{"pose", {{"z", 1}}}}) ==
          "pose.z: expected one of the members x, y");
    CHECK(refusal("{list}ai", {{"list", {1, 2.5}}}) == "list[1]: expected a number of type 'i'");
    CHECK(refusal("{k}i", {{"k", 2147483648LL}}) == "k: expected a number of type 'i'");
    CHECK(refusal("{small}y", {{"small", -1}}) == "small: expected a number of type 'y'");
    CHECK(refusal("{f}f", {{"f", 1e300}}) == "f: expected a number of type 'f'");
    CHECK(refusal("{k}i", {{"k", "5"}}) == "k: expected a number of type 'i'");
    CHECK(refusal("{colour}e#3", {{"colour", 3}}) == "colour: expected an enumerator's number below 3");
    CHECK(refusal("{flag}b", {{"flag", 1}}) == "flag: expected true or false");
    CHECK(refusal("{name}s#3", {{"name", "four"}}) == "name: expected a text of at most 3 bytes without NUL");
    CHECK(refusal("{name}s", {{"name", std::string("a\0b", 3)}}) == "name: expected a text without NUL");
    CHECK(refusal("{list}a#2i", {{"list", {1, 2, 3}}}) == "list: expected at most 2 elements");
    CHECK(refusal("{pair}[2]i", {{"pair", {1}}}) == "pair: expected 2 elements");
    CHECK(refusal("{bytes}ay", {{"bytes", "0g"}}) == "bytes: expected pairs of hexadecimal digits");
    CHECK(refusal("{choice}<i;1={a}d>", {{"choice", 1}}) ==
          "choice: expected an object with the number \"case\"");
    CHECK(refusal("{name}w#2", {{"name", "abc"}}) == "name: expected a text of at most 2 characters");
    CHECK(refusal("{name}w", {{"name", "\U0001f600"}}) ==
          "name: expected a text without NUL, with characters up to U+FFFF");
    CHECK(refusal("{letter}W", {{"letter", "ab"}}) == "letter: expected a text of one character");
    CHECK(refusal("{data}d", 5) == "the message: expected an object");
    CHECK_THAT(refusal("{value}v", {{"value", 1}}),
               Catch::StartsWith("value: expected a type that can be sent"));
    CHECK_THAT(refusal("{big}[16777215][1000]d", nlohmann::json::object()),
               Catch::Contains("at most 16 MiB"));
}

TEST_CASE("types whose values can have no bytes are recognized") {
    CHECK(takes_bytes(wire::parse_signature("i(di)a[3]s")));
    CHECK_FALSE(takes_bytes(wire::parse_signature("i(dv)")));
    CHECK_FALSE(takes_bytes(wire::Type{}));
}
