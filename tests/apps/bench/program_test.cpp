// SPDX-License-Identifier: Apache-2.0
// The program itself, on its smallest run.
#include "apps/bench/report/report.hpp"
#include "apps/bench/suite.hpp"
#include "host/process/run_command.hpp"
#include "tests/apps/bench/folder.hpp"
#include "tests/apps/bench/read_report.hpp"

#include <catch2/catch.hpp>
#include <fstream>

using namespace tandem::bench;
using test::Folder;

namespace {

auto bench(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), BENCH_PROGRAM);
    return tandem::process::run_command(arguments);
}

auto report_py(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"python3", "-B", REPORT_PROGRAM});
    return tandem::process::run_command(arguments);
}

std::string content(const std::string& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace

TEST_CASE("A quick run of baselines and rings yields rows and files and names skipped peers", "[alone]") {
    const Folder folder;
    const auto json = folder.file("a.json");
    const auto result =
        bench({"--only", "baseline/cache-line,baseline/clock,ring/one-way/64/spin,call-queue/call/64/spin",
               "--quick", "--json", json});
    INFO(result.errors);
    REQUIRE(result.exit_code() == 0);
    const Report report = test::from_json(content(json));
    const bool two_cores = allowed_cores().size() > 1;
    for (const Row& row : report.rows) {
        INFO(row.id << ": " << row.skipped);
        if (row.skipped.empty())
            CHECK((row.summary.samples > 0 && row.summary.p50 > 0 && !row.cores.empty()));
        if (row.group == "baseline" && two_cores && row.conditions == "normal") CHECK(row.skipped.empty());
    }
    for (const SkippedPeer& skipped : all_cases().skipped)
        CHECK_THAT(result.output, Catch::Contains("skipped peer/" + skipped.subject));

    const auto plotted = report_py({"plot", json, folder.path});
    INFO(plotted.errors);
    CHECK(plotted.exit_code() == 0);
    CHECK_THAT(content(folder.file("awake.svg")), Catch::Contains("<svg") && Catch::Contains("</svg>"));
}

TEST_CASE("Cold messages are measured through the minimal ring, beside an empty loop", "[alone]") {
    const Folder folder;
    const auto json = folder.file("cold.json");
    const auto result = bench(
        {"--only", "baseline/index-ring/cold-1ms,baseline/empty-loop/cold-1ms", "--quick", "--json", json});
    INFO(result.errors);
    REQUIRE(result.exit_code() == 0);
    std::size_t measured = 0;
    for (const Row& row : test::from_json(content(json)).rows) {
        if (row.operation != "cold-1ms") continue;
        INFO(row.id << ": " << row.skipped);
        if (!row.skipped.empty()) {
            CHECK_THAT(row.skipped, Catch::Contains("needs two cores"));
            continue;
        }
        ++measured;
        CHECK(row.summary.samples == 800); // 0.8 s of intervals
        CHECK(row.summary.p50 > 0);
        CHECK(row.summary.p99 >= row.summary.p50);
    }
    CHECK(measured == (allowed_cores().size() > 1 ? 3 : 1));
}

TEST_CASE("Cold messages cross the bridge in both directions", "[alone]") {
    const Folder folder;
    const auto json = folder.file("cold.json");
    const auto result = bench({"--only", "bridge/cold-10ms", "--quick", "--json", json});
    INFO(result.errors);
    REQUIRE(result.exit_code() == 0);
    for (const Row& row : test::from_json(content(json)).rows) {
        if (row.operation != "cold-10ms" || allowed_cores().size() < 2) continue;
        INFO(row.id << ": " << row.skipped);
        CHECK(row.skipped.empty());
        CHECK(row.summary.samples == 80);
    }
}

TEST_CASE(
    "Calls, structures, pictures and messages that wake their reader cross the bridge in both directions") {
    const Folder folder;
    const auto json = folder.file("bridge.json");
    const auto result =
        bench({"--only",
               "bridge/call/16/spin-then-futex,bridge/note,bridge/one-way/1M,"
               "bridge/one-way/64/blocking/opros-to-rtm,bridge/one-way/64/blocking/rtm-to-opros",
               "--quick", "--json", json});
    INFO(result.errors);
    REQUIRE(result.exit_code() == 0);
    std::size_t measured = 0;
    for (const Row& row : test::from_json(content(json)).rows) {
        if (row.subject != "bridge" || allowed_cores().size() < 2) continue;
        INFO(row.id << ": " << row.skipped);
        // A machine that does not permit low-latency-idle skips these rows.
        if (row.conditions != "normal" && !row.skipped.empty()) continue;
        CHECK(row.skipped.empty());
        CHECK((row.summary.samples > 0 && row.summary.p50 > 0));
        ++measured;
    }
    if (allowed_cores().size() > 1) CHECK(measured >= 8);
}

TEST_CASE("A paired row is a ratio of short windows, and those in which others had the core are counted",
          "[alone]") {
    const Folder folder;
    const auto json = folder.file("paired.json");
    const auto result = bench(
        {"--only",
         "ring/paired/64/spin,call-queue/paired,bridge/paired-one-way/64/spin,bridge/paired-cold-1ms/,"
         "bridge/paired-one-way/64/blocking/opros-to-rtm,bridge/paired-one-way/64/blocking/rtm-to-opros,"
         "bridge/paired-call/16/spin-then-futex,bridge/paired-call/16/blocking,bridge/paired-one-way/1M,"
         "ring/paired/64/blocking,ring/paired-stream/64,ring/paired-stream/1M/spin/copy",
         "--quick", "--json", json});
    INFO(result.errors);
    REQUIRE(result.exit_code() == 0);
    std::size_t measured = 0;
    for (const Row& row : test::from_json(content(json)).rows) {
        if (!row.operation.starts_with("paired") || allowed_cores().size() < 2) continue;
        INFO(row.id << ": " << row.skipped);
        // A machine that does not permit low-latency-idle skips these rows.
        if (row.conditions != "normal" && !row.skipped.empty()) continue;
        ++measured;
        if (!row.skipped.empty()) {
            CHECK_THAT(row.skipped, Catch::Contains("others had the core"));
            continue;
        }
        CHECK(row.unit == "ratio");
        REQUIRE(row.window_counts);
        CHECK(row.window_counts->kept + row.window_counts->dropped == 60);
        CHECK(row.summary.samples == row.window_counts->kept);
        CHECK((row.summary.p25 <= row.summary.p50 && row.summary.p50 <= row.summary.p75));
    }
    if (allowed_cores().size() > 1) CHECK(measured >= 18);
}

TEST_CASE(
    "Tails are measured over the requested number of messages, and over as many through the minimal ring",
    "[alone]") {
    const Folder folder;
    const auto json = folder.file("tails.json");
    const auto result = bench(
        {"--only", "bridge/tail-cold-1ms", "--quick", "--quiet", "--tail-messages", "1100", "--json", json});
    INFO(result.errors);
    REQUIRE(result.exit_code() == 0);
    if (allowed_cores().size() < 2) return;
    for (const Row& row : test::from_json(content(json)).rows) {
        if (row.operation != "tail-cold-1ms") continue;
        INFO(row.id << ": " << row.skipped);
        CHECK(row.skipped.empty());
        CHECK((row.unit == "ratio" && row.summary.samples == 1 && row.summary.p50 > 0));
        CHECK_THAT(result.errors, Catch::Contains(row.id + ": 1100 messages") &&
                                      Catch::Contains("; 1100 over the minimal ring"));
    }
}

TEST_CASE("Invalid options end with one line and an exit code") {
    for (const auto& [arguments, text] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--only", "nothing-of-this-name"}, "--list"},
             {{"--cores", "9999"}, "may not use core 9999"},
             {{"--runs", "0"}, "--runs"}}) {
        const auto result = bench(arguments);
        CHECK(result.exit_code() != 0);
        CHECK_THAT(result.errors, Catch::Contains(text));
    }
}

TEST_CASE("The list names every case and nothing is measured") {
    const auto result = bench({"--list", "--only", "baseline"});
    CHECK(result.exit_code() == 0);
    CHECK_THAT(result.output, Catch::Contains("baseline/cache-line/one-way/8/spin\n"));
    CHECK_THAT(result.output, !Catch::Contains("tandem/"));
}
