// SPDX-License-Identifier: Apache-2.0
// Which ports `tandem link profile` connects. Which types fit is given here.
#include "apps/tandem/link/port_pairs.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <set>
#include <vector>

namespace tandem::command {
namespace {

using Catch::Contains;
using nlohmann::json;

json port(const char* name, const char* direction, const char* kind = "data") {
    return {{"name", name}, {"kind", kind}, {"direction", direction}, {"type", nullptr}};
}

using Ports = std::vector<json>;

/// Matches the ports, where only the named pairs (OPRoS port, RTC port) fit.
PortMatch match(const Ports& opros, const Ports& rtc,
                const std::set<std::pair<std::string, std::string>>& fitting) {
    auto pairs = possible_pairs(opros, rtc);
    for (auto& pair : pairs)
        if (fitting.count({pair.opros["name"], pair.rtc["name"]}) == 0) pair.error = "type mismatch: a, b";
    return match_ports("A", opros, "B", rtc, pairs);
}

std::vector<PortPair> possible(const Ports& opros, const Ports& rtc) { return possible_pairs(opros, rtc); }

std::string text(const PortPair& pair) {
    return pair.opros["name"].get<std::string>() + " " + pair.rtc["name"].get<std::string>() + " " +
           pair.matched;
}

} // namespace

TEST_CASE("ports with the same name are paired before ports with the same type") {
    const auto found = match({port("pos", "output"), port("speed", "output")},
                             {port("speed", "input"), port("pos", "input")},
                             {{"pos", "pos"}, {"pos", "speed"}, {"speed", "pos"}, {"speed", "speed"}});
    REQUIRE(found.pairs.size() == 2);
    CHECK(text(found.pairs[0]) == "pos pos name");
    CHECK(text(found.pairs[1]) == "speed speed name");
    CHECK(found.left_out.empty());
}

TEST_CASE("case and underscores in port names do not matter") {
    const auto found = match({port("wheel_speed", "input")}, {port("wheelSpeed", "output")},
                             {{"wheel_speed", "wheelSpeed"}});
    REQUIRE(found.pairs.size() == 1);
    CHECK_FALSE(found.pairs[0].from_opros());
}

TEST_CASE("ports with different names are paired if no other port fits either of them") {
    const auto found = match({port("cmd", "output"), port("log", "output")},
                             {port("in", "input"), port("text", "input")}, {{"cmd", "in"}, {"log", "text"}});
    REQUIRE(found.pairs.size() == 2);
    CHECK(text(found.pairs[0]) == "cmd in type");
    CHECK(text(found.pairs[1]) == "log text type");
}

TEST_CASE("a port with several fitting ports is left out, and they are named") {
    const auto found = match({port("cmd", "output")}, {port("left", "input"), port("right", "input")},
                             {{"cmd", "left"}, {"cmd", "right"}});
    CHECK(found.pairs.empty());
    REQUIRE(found.left_out.size() == 3);
    CHECK(found.left_out[0] ==
          "A.cmd (data output): several ports of B fit: left, right; connect the intended one by hand");
    CHECK_THAT(found.left_out[1], Contains("B.left (data input)"));
}

TEST_CASE("ports with the same name and different types are left out with the reason") {
    const auto found = match({port("pos", "output")}, {port("pos", "input")}, {});
    CHECK(found.pairs.empty());
    REQUIRE(found.left_out.size() == 2);
    CHECK(found.left_out[0] == "A.pos (data output): type mismatch: a, b");
    CHECK(found.left_out[1] == "B.pos (data input): A.pos has the same name, but its type does not fit");
}

TEST_CASE("ports with the same direction or different kinds are not paired") {
    CHECK(possible({port("x", "output")}, {port("x", "output")}).empty());
    CHECK(possible({port("x", "required", "service")}, {port("x", "input")}).empty());
    CHECK(possible({port("x", "required", "service")}, {port("x", "provided", "service")}).size() == 1);
}

TEST_CASE("AdaptorComp's linkState is paired by name only") {
    const Ports rtc{port("linkState", "output")};
    CHECK(match({port("values", "input")}, rtc, {{"values", "linkState"}}).pairs.empty());
    CHECK(match({port("linkState", "input")}, rtc, {{"linkState", "linkState"}}).pairs.size() == 1);
}

TEST_CASE("the only possible peer, or the first of several, is named with the reason why it does not fit") {
    const auto found =
        match({port("print", "required", "service"), port("speed", "output")},
              {port("echo", "provided", "service"), port("in", "input"), port("in2", "input")}, {});
    REQUIRE(found.pairs.empty());
    REQUIRE(found.left_out.size() == 5);
    CHECK(found.left_out[0] == "A.print (service required): type mismatch: a, b");
    CHECK(found.left_out[1] ==
          "A.speed (data output): no input data port of B is left whose type fits; in: type mismatch: a, b");
    CHECK(found.left_out[2] ==
          "B.echo (service provided): no required service port of A is left whose type fits");
}

TEST_CASE("ports of OPRoS components for the engine's tools are not joined") {
    const auto found = match({port("opros.symbol", "provided", "service")},
                             {port("asked", "required", "service")}, {{"opros.symbol", "asked"}});
    CHECK(found.pairs.empty());
    CHECK(found.left_out ==
          std::vector<std::string>{
              "B.asked (service required): no provided service port of A is left whose type fits"});
}

} // namespace tandem::command
