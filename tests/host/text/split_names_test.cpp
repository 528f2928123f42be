// SPDX-License-Identifier: Apache-2.0
#include "host/text/split_names.hpp"

#include <catch2/catch.hpp>

using tandem::text::split_names;

TEST_CASE("a list of names is split at commas, without blanks and empty names") {
    CHECK(split_names(" Arm,Leg , \n\tHead,,") == std::vector<std::string>{"Arm", "Leg", "Head"});
    CHECK(split_names(" ").empty());
}
