// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/report/acceptance.hpp"
#include "apps/bench/report/table.hpp"
#include "tests/apps/bench/read_report.hpp"
#include "tests/apps/bench/report_fixture.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace tandem::bench;
using test::report;
using test::row;
using Comparison = AcceptanceLimit::Comparison;

TEST_CASE("A limit is checked against the median of the ratios of each run") {
    const std::vector<AcceptanceLimit> limits{{"x", Comparison::at_most, 1.2, "tandem/a", "baseline/b"}};
    // Run by run 1.0, 3.0, 1.1; the ratio of the medians would be 1.65.
    const auto results = check_acceptance(
        limits, report({row("tandem/a", {100, 300, 220}), row("baseline/b", {100, 100, 200})}));
    REQUIRE(results.size() == 1);
    CHECK(results[0].value == Approx(1.1));
    CHECK(results[0].min == Approx(1.0));
    CHECK(results[0].max == Approx(3.0));
    CHECK(results[0].passed());
}

TEST_CASE("A paired row is checked by the median of its windows and shown with their quartiles") {
    Row paired = row("tandem/paired", {1.1}, "ratio");
    paired.summary = summarize({1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7});
    paired.runs = {paired.summary.p50};
    paired.window_counts = {8, 2};
    const auto results =
        check_acceptance({{"x", Comparison::at_most, 1.35, "tandem/paired", ""}}, report({paired}));
    CHECK(results[0].value == Approx(1.3));
    CHECK(results[0].min == Approx(1.1));
    CHECK(results[0].max == Approx(1.5));
    CHECK(results[0].passed());
    const Row again = test::from_json(to_json(report({paired}))).rows.at(0);
    CHECK(again.summary.p25 == paired.summary.p25);
    CHECK(again.summary.p75 == paired.summary.p75);
    REQUIRE(again.window_counts);
    CHECK((again.window_counts->kept == 8 && again.window_counts->dropped == 2));
}

TEST_CASE("The limit of a paired row may depend on how long a message over its floor takes") {
    const AcceptanceLimit limit{"x", Comparison::at_most, 1.5, "tandem/paired", "", 2.0};
    const auto [floor_ns, expected] =
        GENERATE(table<double, double>({{0, 1.5}, {40, 4}, {80, 2}, {115, 1.75}, {150, 1.5}, {290, 1.5}}));
    Row paired = row("tandem/paired", {1.7}, "ratio");
    paired.window_counts = {8, 2, floor_ns};
    const auto result = check_acceptance({limit}, report({paired})).at(0);
    CHECK(result.limit.limit == Approx(expected));
    CHECK(result.passed() == (expected > 1.7));
    CHECK(test::from_json(to_json(report({paired}))).rows.at(0).window_counts->floor_ns == floor_ns);
}

TEST_CASE("Between two threads of one core a case may take as long as over a line of 80 ns") {
    const AcceptanceLimit limit{"x", Comparison::at_most, 1.2, "tandem/paired", ""};
    CHECK(limit.limit_at(0) == 1.2);
    CHECK(limit.limit_at(100) == 1.2);
    CHECK(limit.limit_at(80) == 1.2);
    CHECK(limit.limit_at(40) == Approx(2.4));
    const AcceptanceLimit of_stream{"x", Comparison::at_most, 2, "tandem/paired-stream", "", {}, 50};
    CHECK(of_stream.limit_at(60) == 2);
    CHECK(of_stream.limit_at(25) == Approx(4));
}

TEST_CASE("The floor's time of several runs is the mean of their windows") {
    WindowCounts counts{2, 1, 100};
    counts.add({6, 0, 200});
    counts.add({0, 5, 0});
    CHECK(counts.floor_ns == Approx(175));
    CHECK(counts.kept == 8);
    CHECK(counts.dropped == 6);
}

TEST_CASE("Limits are checked in both directions and for figures without a denominator") {
    const Report of = report({row("tandem/a", {41}, "M/s"), row("baseline/b", {10}, "M/s")});
    CHECK(check_acceptance({{"x", Comparison::at_least, 40, "tandem/a", ""}}, of)[0].passed());
    CHECK_FALSE(check_acceptance({{"x", Comparison::at_least, 42, "tandem/a", ""}}, of)[0].passed());
    CHECK(check_acceptance({{"x", Comparison::at_least, 4, "tandem/a", "baseline/b"}}, of)[0].passed());
    CHECK_FALSE(check_acceptance({{"x", Comparison::at_most, 4, "tandem/a", "baseline/b"}}, of)[0].passed());
}

TEST_CASE("Every limit compares existing cases") {
    const Registry registry = all_cases();
    std::vector<std::string> ids;
    for (const Case& each : registry.cases) ids.push_back(each.id());
    const auto has = [&](const std::string& id) {
        if (id.empty() || std::find(ids.begin(), ids.end(), id) != ids.end()) return true;
        // A peer that this build lacks is named with its reason instead.
        return std::any_of(registry.skipped.begin(), registry.skipped.end(), [&](const SkippedPeer& peer) {
            return id.starts_with("peer/" + peer.subject + "/");
        });
    };
    const auto limits = acceptance_limits(ids);
    CHECK_FALSE(limits.empty());
    for (const AcceptanceLimit& limit : limits) {
        INFO(limit.description << ": " << limit.numerator << ", " << limit.denominator);
        CHECK((has(limit.numerator) && has(limit.denominator)));
    }
}

TEST_CASE("A limit without its rows is skipped by name and reason and does not pass") {
    const std::vector<AcceptanceLimit> limits{
        {"of a peer", Comparison::at_least, 6, "peer/iceoryx/one-way", "tandem/a"}};
    const auto results = check_acceptance(
        limits, report({row("tandem/a", {1}), test::skipped("peer/iceoryx", "not installed")}));
    CHECK_FALSE(results[0].passed());
    CHECK_THAT(acceptance_text(results), Catch::Contains("of a peer") &&
                                             Catch::Contains("skipped: not installed") &&
                                             Catch::Contains("0 pass, 0 FAIL, 1 skipped"));
}

TEST_CASE(
    "A case of Tandem that has failed in each run is not accepted, and neither is a report without figures") {
    const std::vector<AcceptanceLimit> limits{
        {"met", Comparison::at_most, 1.2, "tandem/a", "baseline/b"},
        {"broken", Comparison::at_most, 1.2, "tandem/c", ""},
        {"of a peer", Comparison::at_least, 6, "peer/x/one-way", "tandem/a"}};
    const std::vector<Row> good{row("tandem/a", {100}), row("baseline/b", {100})};
    const auto accepted = [&](Row third) {
        return is_accepted(check_acceptance(limits, report({good[0], good[1], std::move(third)})));
    };
    CHECK(accepted(row("tandem/c", {1})));
    CHECK(accepted(test::skipped("tandem/c", "needs two cores")));
    CHECK(accepted(test::skipped("peer/x", "not installed")));
    CHECK_FALSE(accepted(row("tandem/c", {2})));
    Row crashed = test::skipped("tandem/c", "side A was ended by signal 11");
    crashed.runs = {NAN, NAN};
    CHECK_FALSE(accepted(crashed));
    CHECK_FALSE(is_accepted(check_acceptance(limits, report({}))));
    CHECK_FALSE(is_accepted({}));
}

TEST_CASE("A limit that is missed names its cases, both of a ratio, to be measured again") {
    const std::vector<AcceptanceLimit> limits{
        {"missed alone", Comparison::at_most, 1000, "tandem/tick", ""},
        {"missed ratio", Comparison::at_most, 1.2, "tandem/a", "baseline/b"},
        {"met", Comparison::at_most, 1.2, "tandem/c", "baseline/d"},
        {"skipped", Comparison::at_least, 6, "peer/x/one-way", "tandem/c"}};
    const auto missed = missed_limits(
        limits, report({row("tandem/tick", {2500}), row("tandem/a", {130}), row("baseline/b", {100}),
                        row("tandem/c", {100}), row("baseline/d", {100}), test::skipped("peer/x", "")}));
    CHECK(missed.size() == 2);
    for (const char* id : {"tandem/tick", "tandem/a", "baseline/b"}) CHECK(needed_for_acceptance(missed, id));
    for (const char* id : {"tandem/c", "baseline/d", "peer/x/one-way"})
        CHECK_FALSE(needed_for_acceptance(missed, id));
}

TEST_CASE("What was tried without success is measured again and what cannot be tried is not") {
    const std::vector<AcceptanceLimit> limits{{"x", Comparison::at_most, 1.2, "tandem/a", "baseline/b"}};
    Row tried = test::skipped("tandem/a", "others had the core");
    const Row floor = row("baseline/b", {100});
    CHECK(missed_limits(limits, report({tried, floor})).empty());
    tried.runs = {NAN};
    CHECK(missed_limits(limits, report({tried, floor})).size() == 1);
    tried.runs = {NAN, NAN, NAN};
    tried.measured_again = 2;
    const Report of = test::from_json(to_json(report({tried, floor})));
    CHECK(check_acceptance(limits, of).at(0).verdict() ==
          "skipped: others had the core; 2 times more as well");
    Row a = row("tandem/a", {NAN, 110, 115}), b = row("baseline/b", {100, 100, 100});
    a.measured_again = b.measured_again = 2;
    CHECK(check_acceptance(limits, report({a, b})).at(0).verdict() ==
          "pass, measured 3 times: - 1.100 1.150");
}

TEST_CASE("What was measured again counts with the median of all measurements, each of which is shown") {
    const auto [runs, verdict] = GENERATE(table<std::vector<double>, std::string>(
        {{{2500, 310, 290}, "pass, measured 3 times: 2500 310.0 290.0"},
         {{2500, 310, 1200}, "FAIL, measured 3 times: 2500 310.0 1200"},
         {{2500, NAN, 310}, "FAIL, measured 3 times: 2500 - 310.0"}}));
    Row tick = row("tandem/tick", runs);
    tick.measured_again = 2;
    const Report of = test::from_json(to_json(report({tick, row("tandem/a", {100})})));
    const auto results = check_acceptance({{"tick", Comparison::at_most, 1000, "tandem/tick", ""},
                                           {"a", Comparison::at_most, 1000, "tandem/a", ""}},
                                          of);
    CHECK(results.at(0).verdict() == verdict);
    CHECK(results.at(1).verdict() == "pass");
    CHECK_THAT(acceptance_text(results), Catch::Contains(verdict) && Catch::Contains("; 1 measured again\n"));
    CHECK_THAT(table_text(of), Catch::Contains(verdict.substr(verdict.find("measured"))));
}

TEST_CASE("A ratio is taken of the runs in which both of its cases were measured") {
    Row a = row("tandem/a", {100, 900, 900}), b = row("baseline/b", {100});
    a.measured_again = 2; // because of another limit
    const std::vector<AcceptanceLimit> limits{{"x", Comparison::at_most, 1.2, "tandem/a", "baseline/b"}};
    CHECK(check_acceptance(limits, report({a, b})).at(0).verdict() == "pass");
    b = row("baseline/b", {50, 900, 900});
    b.measured_again = 2;
    CHECK(check_acceptance(limits, report({a, b})).at(0).verdict() ==
          "pass, measured 3 times: 2.000 1.000 1.000");
}

TEST_CASE("A peer that can sleep has a limit under both conditions in which its software decides") {
    const std::string id = "peer/quick/paired/64/blocking/";
    const auto limits =
        acceptance_limits({id + "same-core", id + "low-latency-idle", "peer/quick/paired/64/blocking"});
    CHECK(needed_for_acceptance(limits, id + "same-core"));
    CHECK(needed_for_acceptance(limits, id + "low-latency-idle"));
    CHECK_FALSE(needed_for_acceptance(limits, "peer/quick/paired/64/blocking"));
}
