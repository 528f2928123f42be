// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/table.hpp"
#include "host/process/run_command.hpp"
#include "tests/apps/bench/folder.hpp"
#include "tests/apps/bench/read_report.hpp"
#include "tests/apps/bench/report_fixture.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

using namespace tandem::bench;
using test::from_json;
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

TEST_CASE("A row of ticks states how many were late by a period or more, and how many periods were lost") {
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

TEST_CASE("The table names conditions and percentiles and what was skipped") {
    const std::string text =
        table_text(report({row("tandem/a", {200}), test::skipped("peer/x", "not here")}));
    for (const char* part : {"Linux 6.1", "rdtsc", "p99.9", "tandem/a", "skipped peer/x: not here"})
        CHECK_THAT(text, Catch::Contains(part));
}

namespace {

struct Compared {
    explicit Compared(const Report& before, const Report& after) {
        std::ofstream(folder.file("old.json")) << to_json(before);
        std::ofstream(folder.file("new.json")) << to_json(after);
        result = tandem::process::run_command(
            {"python3", "-B", REPORT_PROGRAM, "compare", folder.file("old.json"), folder.file("new.json")});
    }
    test::Folder folder;
    tandem::process::CommandResult result;
};

std::string changes(const Report& before, const Report& after) {
    return Compared(before, after).result.output;
}

} // namespace

TEST_CASE(
    "A comparison names the change beyond the spread of the runs, and its direction depends on the unit") {
    const std::string text = changes(
        report({row("a", {100, 101, 102}), row("b", {40, 41, 42}, "M/s"), row("same", {50, 51, 52})}),
        report({row("a", {130, 131, 132}), row("b", {60, 61, 62}, "M/s"), row("same", {51, 52, 50})}));
    INFO(text);
    const auto better = text.find("better  b "), worse = text.find("WORSE   a ");
    REQUIRE((better != std::string::npos && worse != std::string::npos));
    CHECK(better < worse); // the largest change first
    CHECK_THAT(text, Catch::Contains("x 1.30") && Catch::Contains("2 of 3 common rows"));
}

TEST_CASE("A comparison reports no change within the spread of either report") {
    const auto none = Catch::Contains("\n0 of 1 common rows");
    CHECK_THAT(changes(report({row("a", {100, 140, 120})}), report({row("a", {130, 131, 132})})), none);
    // One run of a report lies among those of the other.
    CHECK_THAT(changes(report({row("a", {100, 100, 400})}), report({row("a", {390, 1200, 1300})})), none);
    // Single runs of one program differ by this much.
    CHECK_THAT(changes(report({row("a", {100})}), report({row("a", {114})})), none);
    CHECK_THAT(changes(report({row("a", {100})}), report({row("a", {120})})),
               Catch::Contains("\n1 of 1 common rows"));
}

TEST_CASE("A comparison ignores rows that one report lacks") {
    CHECK_THAT(
        changes(report({row("a", {100}), test::skipped("b", "x")}), report({row("b", {1}), row("c", {1})})),
        Catch::Contains("\n0 of 0 common rows"));
}

TEST_CASE("report.py refuses a file that is not a report in one line") {
    const test::Folder folder;
    for (const char* text : {"", "{}", "[1,2]", R"({"tandem_bench":99})"}) {
        INFO(text);
        const std::string file = folder.file("report.json");
        std::ofstream(file) << text;
        const auto result =
            tandem::process::run_command({"python3", "-B", REPORT_PROGRAM, "compare", file, file});
        CHECK(result.exit_code() != 0);
        CHECK_THAT(result.errors, Catch::StartsWith("report.py: " + file));
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
    }
}
