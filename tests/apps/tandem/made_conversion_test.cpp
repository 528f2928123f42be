// SPDX-License-Identifier: Apache-2.0
// How `tandem link check` describes the conversion of a value.
#include "apps/tandem/link/made_conversion.hpp"

#include <catch2/catch.hpp>

namespace tandem::command {

TEST_CASE("a time missing on one side is reported, and equal types need no conversion") {
    CHECK(made_conversion("s", "s").empty());
    CHECK(made_conversion("s", "(uu)s") == "tm is set");
    CHECK(made_conversion("(uu)s", "s") == "tm is left out");
}

TEST_CASE("only device types fit although their signatures differ") {
    CHECK(made_conversion("ddd", "(uu)(ddd)(ddd)") == "device");
}

TEST_CASE("a union and its class with a single case are not device types") {
    const char* const of_idl = "(uu)<i;0=d;1=s;*=i>";
    CHECK(made_conversion("(id)", of_idl) == "union, tm is set");
    CHECK(made_conversion(of_idl, "(id)") == "union, tm is left out");
    CHECK(made_conversion("a(id)", "a<i;0=d;1=s>") == "union");
    CHECK(made_conversion("(uu)(id)", of_idl) == "union");
}

} // namespace tandem::command
