// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/html.hpp"
#include "apps/bench/report/table.hpp"
#include "tests/apps/bench/report_fixture.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <pugixml.hpp>

using namespace tandem::bench;
using test::report;
using test::row;

TEST_CASE("A report is the same after being written as JSON and read") {
    const Report before =
        report({row("tandem/ring/one-way/64/spin", {200, NAN, 210}), test::skipped("peer/x", "not here")});
    const std::string text = to_json(before);
    const Report after = from_json(text);
    CHECK(to_json(after) == text);
    REQUIRE(after.rows.size() == 2);
    CHECK(after.machine.processor == before.machine.processor);
    CHECK(after.rows[0].summary.p50 == before.rows[0].summary.p50);
    CHECK(after.rows[0].summary.curve.size() == before.rows[0].summary.curve.size());
    REQUIRE(after.rows[0].runs.size() == 3);
    CHECK(std::isnan(after.rows[0].runs[1]));
    CHECK(after.rows[1].skipped == "not here");
    CHECK(after.find("peer/x") == nullptr);
}

TEST_CASE("A row of ticks says how many came late by a period or more and how many periods that cost") {
    Row ticks = row("tandem/opros/tick/8/blocking", {900});
    ticks.tick_counts = TickCounts{2, 5};
    const Report before = report({ticks, row("tandem/a", {200})});
    const Report after = from_json(to_json(before));
    REQUIRE(after.rows.at(0).tick_counts);
    CHECK(after.rows[0].tick_counts->overruns == 2);
    CHECK(after.rows[0].tick_counts->skipped == 5);
    CHECK_FALSE(after.rows.at(1).tick_counts);
    CHECK_THAT(table_text(after), Catch::Contains(" 2 overruns, 5 periods skipped\n"));
}

TEST_CASE("A text that is not a report is refused in one line") {
    for (const char* text : {"", "{}", "[1,2]", R"({"tandem_bench":99})"}) {
        INFO(text);
        CHECK_THROWS_WITH(from_json(text), !Catch::Contains("\n"));
    }
}

TEST_CASE("The table names conditions and percentiles and what was skipped") {
    const std::string text =
        table_text(report({row("tandem/a", {200}), test::skipped("peer/x", "not here")}));
    for (const char* part : {"Linux 6.1", "rdtsc", "p99.9", "tandem/a", "skipped peer/x: not here"})
        CHECK_THAT(text, Catch::Contains(part));
}

TEST_CASE("The HTML page is well-formed and has its plots and rows inside") {
    Row asleep = row("tandem/ring/one-way/64/blocking", {900});
    asleep.wake = "blocking";
    const std::string page = html_page(
        report({row("tandem/ring/one-way/64/spin", {200}), asleep, test::skipped("peer/x", "a < b")}), {});
    pugi::xml_document document;
    const auto parsed = document.load_string(page.c_str());
    INFO(parsed.description());
    REQUIRE(parsed);
    CHECK(document.select_nodes("//*[local-name()='svg']").size() >= 3); // awake, asleep, by size
    CHECK(document.select_nodes("//table//tr").size() >= 3);
    CHECK_THAT(page, Catch::Contains("a &lt; b"));
    CHECK_THAT(page, !Catch::Contains("href=\"http") && !Catch::Contains("src=")); // self-contained
}
