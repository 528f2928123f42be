// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/compare.hpp"
#include "tests/apps/bench/report_fixture.hpp"

#include <catch2/catch.hpp>

using namespace tandem::bench;
using test::report;
using test::row;

TEST_CASE("A change beyond the spread of the runs is found and its direction depends on the unit") {
    const Report before =
        report({row("a", {100, 101, 102}), row("b", {40, 41, 42}, "M/s"), row("same", {50, 51, 52})});
    const Report after =
        report({row("a", {130, 131, 132}), row("b", {60, 61, 62}, "M/s"), row("same", {51, 52, 50})});
    const auto found = significant_changes(before, after);
    REQUIRE(found.size() == 2);
    CHECK(found[0].id == "b"); // largest first
    CHECK(found[0].better);
    CHECK(found[1].id == "a");
    CHECK_FALSE(found[1].better);
    CHECK(found[1].ratio() == Approx(131.0 / 101.0));
    CHECK_THAT(compare_text(before, after),
               Catch::Contains("WORSE") && Catch::Contains("2 of 3 common rows"));
}

TEST_CASE("A change within the spread of either report is none") {
    const auto found =
        significant_changes(report({row("a", {100, 140, 120})}), report({row("a", {130, 131, 132})}));
    CHECK(found.empty());
}

TEST_CASE("A run of one report among those of the other is no change however far the medians are apart") {
    CHECK(significant_changes(report({row("a", {100, 100, 400})}), report({row("a", {390, 1200, 1300})}))
              .empty());
}

TEST_CASE("One run alone must differ by more than two runs of one program may") {
    CHECK(significant_changes(report({row("a", {100})}), report({row("a", {114})})).empty());
    CHECK(significant_changes(report({row("a", {100})}), report({row("a", {120})})).size() == 1);
}

TEST_CASE("Rows that one report lacks are not compared") {
    CHECK(significant_changes(report({row("a", {100}), test::skipped("b", "x")}),
                              report({row("b", {1}), row("c", {1})}))
              .empty());
}
