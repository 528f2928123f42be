// SPDX-License-Identifier: Apache-2.0
#include "host/text/join.hpp"

#include <catch2/catch.hpp>
#include <vector>

using tandem::text::join;

TEST_CASE("texts of items are joined with the separator only between them") {
    CHECK(join(std::vector<std::string>{}, ", ").empty());
    CHECK(join(std::vector<std::string>{"Arm"}, ", ") == "Arm");
    CHECK(join(std::vector<std::string>{"Arm", "Leg", "Head"}, ", ") == "Arm, Leg, Head");
    CHECK(join(std::vector<std::string>{"", "Leg", ""}, ",") == ",Leg,"); // as many items as before
    struct Named {
        std::string name;
    };
    CHECK(join(std::vector<Named>{{"Arm"}, {"Leg"}}, ";", &Named::name) == "Arm;Leg");
    CHECK(join(std::vector<int>{1, 2}, " ", [](int number) { return std::to_string(number); }) == "1 2");
}
