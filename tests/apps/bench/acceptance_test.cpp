// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/acceptance.hpp"
#include "tests/apps/bench/report_fixture.hpp"

#include <catch2/catch.hpp>

using namespace tandem::bench;
using test::report;
using test::row;
using Sense = BarLine::Sense;

TEST_CASE("A line is judged by the median of the ratios of each run") {
    const std::vector<BarLine> lines{{"x", Sense::at_most, 1.2, "ours/a", "floor/b"}};
    // Run by run 1.0, 3.0, 1.1; the ratio of the medians would be 1.65.
    const auto results =
        judge(lines, report({row("ours/a", {100, 300, 220}), row("floor/b", {100, 100, 200})}));
    REQUIRE(results.size() == 1);
    CHECK(results[0].value == Approx(1.1));
    CHECK(results[0].least == Approx(1.0));
    CHECK(results[0].most == Approx(3.0));
    CHECK(results[0].pass());
}

TEST_CASE("Bounds hold in both senses and for figures without a second side") {
    const Report of = report({row("ours/a", {41}, "M/s"), row("floor/b", {10}, "M/s")});
    CHECK(judge({{"x", Sense::at_least, 40, "ours/a", ""}}, of)[0].pass());
    CHECK_FALSE(judge({{"x", Sense::at_least, 42, "ours/a", ""}}, of)[0].pass());
    CHECK(judge({{"x", Sense::at_least, 4, "ours/a", "floor/b"}}, of)[0].pass());
    CHECK_FALSE(judge({{"x", Sense::at_most, 4, "ours/a", "floor/b"}}, of)[0].pass());
}

TEST_CASE("A line without its rows is skipped by name and reason and does not pass") {
    const std::vector<BarLine> lines{{"peer line", Sense::at_least, 6, "peer/iceoryx/one-way", "ours/a"}};
    const auto results =
        judge(lines, report({row("ours/a", {1}), test::skipped("peer/iceoryx", "not installed")}));
    CHECK_FALSE(results[0].pass());
    CHECK_THAT(bar_text(results), Catch::Contains("peer line") && Catch::Contains("skipped: not installed") &&
                                      Catch::Contains("0 pass, 0 FAIL, 1 skipped"));
}

TEST_CASE("A peer that can sleep has its lines in both regimes in which the software shows") {
    const std::string id = "peer/quick/one-way/64/blocking/";
    const auto lines =
        bar_lines({id + "same-core", id + "low-latency-idle", "peer/quick/one-way/64/blocking"});
    CHECK(needed_for_bar(lines, id + "same-core"));
    CHECK(needed_for_bar(lines, id + "low-latency-idle"));
    CHECK_FALSE(needed_for_bar(lines, "peer/quick/one-way/64/blocking"));
}
