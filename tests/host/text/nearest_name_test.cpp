// SPDX-License-Identifier: Apache-2.0
#include "host/text/nearest_name.hpp"

#include <catch2/catch.hpp>

using namespace tandem::text;

TEST_CASE("the edit distance counts inserted, deleted and replaced letters") {
    CHECK(edit_distance("", "") == 0);
    CHECK(edit_distance("speed_x", "speed_x") == 0);
    CHECK(edit_distance("sped_x", "speed_x") == 1);
    CHECK(edit_distance("speed_x", "") == 7);
    CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("a misspelt name is taken for the nearest known one, and a strange one for none") {
    const std::vector<std::string> names{"speed_x", "speed_y", "GripperAPI", "ApiName"};
    CHECK(did_you_mean("sped_x", names) == "; did you mean speed_x?");
    CHECK(did_you_mean("GriiperAPI", names) == "; did you mean GripperAPI?");
    CHECK(did_you_mean("APINAME", names) == "; did you mean ApiName?");
    CHECK(did_you_mean("colour", names).empty());
    CHECK(did_you_mean("x", names).empty());
    CHECK(did_you_mean(std::string(1000, 'x'), names).empty());
    CHECK(did_you_mean("sped_x", {}).empty());
    CHECK(nearest_name("colour", {}).empty());
}
