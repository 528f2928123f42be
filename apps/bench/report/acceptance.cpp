// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/acceptance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tandem::bench {

namespace {

using Sense = BarLine::Sense;

constexpr const char* cache_line = "floor/cache-line/one-way/8/spin";
constexpr const char* minimal_ring = "floor/index-ring/one-way/64/spin";

const std::vector<std::string>& asleep_regimes() {
    static const std::vector<std::string> regimes{"", "/low-latency-idle", "/same-core"};
    return regimes;
}

/// On one core our mode for it, which yields before it sleeps.
std::string ours_asleep(const std::string& regime) {
    return (regime == "/same-core" ? "ours/ring/one-way/64/spin-then-futex"
                                   : "ours/ring/one-way/64/blocking") +
           regime;
}

void add_one_way(std::vector<BarLine>& lines) {
    lines.push_back({"one-way 48 B, polling / cache line", Sense::at_most, 1.15, "ours/ring/one-way/48/spin",
                     cache_line});
    lines.push_back({"one-way 64 B, polling / minimal ring", Sense::at_most, 1.2, "ours/ring/one-way/64/spin",
                     minimal_ring});
    lines.push_back({"iceoryx take / one-way 64 B, polling", Sense::at_least, 6,
                     "peer/iceoryx/one-way/64/spin", "ours/ring/one-way/64/spin"});
    lines.push_back({"one-way 64 B, spin-then-futex, awake / minimal ring", Sense::at_most, 1.4,
                     "ours/ring/one-way/64/spin-then-futex", minimal_ring});
    for (const std::string& regime : asleep_regimes())
        lines.push_back({fmt::format("one-way 64 B, asleep, {} / bare futex ring",
                                     regime.empty() ? "halted" : regime.substr(1)),
                         Sense::at_most, 1.05, ours_asleep(regime),
                         "floor/index-ring/one-way/64/blocking" + regime});
}

/// Every peer that can sleep, in the two regimes in which the software shows.
void add_asleep_peers(std::vector<BarLine>& lines, const std::vector<std::string>& ids) {
    for (const std::string regime : {"low-latency-idle", "same-core"})
        for (const std::string& id : ids) {
            if (id.rfind("peer/", 0) != 0 || id.find("/one-way/64/blocking") == std::string::npos ||
                !id.ends_with("/" + regime))
                continue;
            const std::string who = id.substr(5, id.find('/', 5) - 5);
            lines.push_back({fmt::format("{} asleep, {} / ours", who, regime), Sense::at_least, 1, id,
                             ours_asleep("/" + regime)});
        }
}

void add_opros(std::vector<BarLine>& lines) {
    lines.push_back({"OPRoS push of a double, ns", Sense::at_most, 300, "ours/opros/push/8", ""});
    lines.push_back(
        {"OPRoS push of vector<double>(1000), ns", Sense::at_most, 1000, "ours/opros/push/8000", ""});
    lines.push_back({"OPRoS blocking service call, ns", Sense::at_most, 200, "ours/opros/local-call/8", ""});
    lines.push_back({"OPRoS event to call-back, low-latency-idle, ns", Sense::at_most, 10'000,
                     "ours/opros/event/8/blocking/low-latency-idle", ""});
    lines.push_back(
        {"OPRoS 1 ms tick with tick-spin, late by ns", Sense::at_most, 1000, "ours/opros/tick/8/spin", ""});
    lines.push_back({"OPRoS 1 ms tick / cyclictest", Sense::at_most, 1.5, "ours/opros/tick/8/blocking",
                     "peer/cyclictest/tick/8/blocking"});
}

void add_rtm(std::vector<BarLine>& lines) {
    lines.push_back({"RTM write of TimedLong, ns", Sense::at_most, 500, "ours/rtm/write/12/direct", ""});
    lines.push_back(
        {"RTM write of TimedDoubleSeq of 3, ns", Sense::at_most, 500, "ours/rtm/write/36/direct", ""});
    lines.push_back({"RTM allocations per 100,000 writes and reads", Sense::at_most, 0,
                     "ours/rtm/write-allocations/48/direct", ""});
    lines.push_back({"RTM service call, ns", Sense::at_most, 500, "ours/rtm/local-call/8", ""});
    lines.push_back(
        {"RTM 1 ms tick with tick-spin, late by ns", Sense::at_most, 1000, "ours/rtm/tick/8/spin", ""});
    lines.push_back({"RTM 1 ms tick / cyclictest", Sense::at_most, 1.5, "ours/rtm/tick/8/blocking",
                     "peer/cyclictest/tick/8/blocking"});
}

void add_rest(std::vector<BarLine>& lines) {
    lines.push_back({"call, polling / floor pair", Sense::at_most, 1.5, "ours/call-queue/call/64/spin",
                     "floor/ring-pair/call/64/spin"});
    lines.push_back({"iceoryx client/server / call, polling", Sense::at_least, 5, "peer/iceoryx/call/64/spin",
                     "ours/call-queue/call/64/spin"});
    lines.push_back(
        {"64 B records, million per second", Sense::at_least, 40, "ours/ring/stream/64/spin", ""});
    for (const std::string size : {"1M", "6M"}) {
        const std::string ours = "ours/ring/stream/" + size + "/spin/loan";
        lines.push_back({size + "iB by loan / zero-copy floor", Sense::at_least, 0.97, ours,
                         "floor/index-ring/stream/" + size + "/spin/zero-copy"});
        // Both are at the memory's limit: "not behind" is within the noise of a run.
        lines.push_back({size + "iB by loan / iceoryx", Sense::at_least, 0.97, ours,
                         "peer/iceoryx/stream/" + size + "/spin/loan"});
    }
    lines.push_back({"1MiB by copy / copying floor", Sense::at_least, 0.95, "ours/ring/stream/1M/spin/copy",
                     "floor/index-ring/stream/1M/spin/copy"});
    for (const std::string direction : {"opros-to-rtm", "rtm-to-opros"})
        lines.push_back({"component to component, " + direction + " / minimal ring", Sense::at_most, 3,
                         "ours/bridge/one-way/64/spin/" + direction, minimal_ring});
    lines.push_back({"one-way, 256 ports open, one used / one port", Sense::at_most, 1.2,
                     "ours/ring/ports/64/spin-then-futex/256 ports (1 used)",
                     "ours/ring/ports/64/spin-then-futex/1 port"});
    lines.push_back({"one-way round 256 ports / one port", Sense::at_most, 1.2,
                     "ours/ring/ports/64/spin-then-futex/256 ports",
                     "ours/ring/ports/64/spin-then-futex/1 port"});
    add_opros(lines);
    add_rtm(lines);
    for (const std::string wake : {"spin", "spin-then-futex"}) {
        lines.push_back({"system calls per 100,000 publishes, " + wake, Sense::at_most, 0,
                         "ours/ring/publish-system-calls/64/" + wake, ""});
        lines.push_back({"allocations per 100,000 publishes, " + wake, Sense::at_most, 0,
                         "ours/ring/publish-allocations/64/" + wake, ""});
    }
}

std::string why_missing(const Report& report, const std::string& id) {
    for (const Row& row : report.rows) // "peer/iceoryx" stands for all of its cases
        if (!row.skipped.empty() && (row.id == id || id.rfind(row.id + "/", 0) == 0)) return row.skipped;
    return "not measured: " + id;
}

} // namespace

std::string BarLine::text() const { return what; }

bool BarLine::holds(double value) const {
    const double shown = std::round(value * 1000) / 1000;
    return sense == Sense::at_most ? shown <= bound : shown >= bound;
}

std::vector<BarLine> bar_lines(const std::vector<std::string>& ids) {
    std::vector<BarLine> lines;
    add_one_way(lines);
    add_asleep_peers(lines, ids);
    add_rest(lines);
    return lines;
}

bool needed_for_bar(const std::vector<BarLine>& lines, const std::string& id) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const BarLine& line) { return line.over == id || line.under == id; });
}

std::vector<BarResult> judge(const std::vector<BarLine>& lines, const Report& report) {
    std::vector<BarResult> results;
    for (const BarLine& line : lines) {
        BarResult result{line, 0, 0, 0, ""};
        const Row* over = report.find(line.over);
        const Row* under = line.under.empty() ? nullptr : report.find(line.under);
        if (over == nullptr)
            result.missing = why_missing(report, line.over);
        else if (under == nullptr && !line.under.empty())
            result.missing = why_missing(report, line.under);
        if (result.missing.empty()) {
            std::vector<double> values; // of each run in which both were measured
            for (std::size_t i = 0; i < over->runs.size(); ++i) {
                const double below = under == nullptr ? 1.0 : i < under->runs.size() ? under->runs[i] : NAN;
                if (std::isfinite(over->runs[i] / below)) values.push_back(over->runs[i] / below);
            }
            if (values.empty())
                result.missing = "no run has both sides";
            else {
                result.value = median(values);
                result.least = *std::min_element(values.begin(), values.end());
                result.most = *std::max_element(values.begin(), values.end());
            }
        }
        results.push_back(std::move(result));
    }
    return results;
}

std::string bar_text(const std::vector<BarResult>& results) {
    std::string out = fmt::format("{:<58} {:>9} {:>19} {:>9}\n", "bar: median of the runs", "measured",
                                  "least .. most", "bound");
    std::size_t passed = 0, failed = 0;
    for (const BarResult& result : results) {
        const char* sign = result.line.sense == Sense::at_most ? "<=" : ">=";
        const std::string bound = fmt::format("{} {:g}", sign, result.line.bound);
        if (!result.missing.empty()) {
            out += fmt::format("{:<58} {:>9} {:>19} {:>9}  skipped: {}\n", result.line.text(), "-", "-",
                               bound, result.missing);
            continue;
        }
        ++(result.pass() ? passed : failed);
        out += fmt::format("{:<58} {:>9.3f} {:>19} {:>9}  {}\n", result.line.text(), result.value,
                           fmt::format("{:.3f} .. {:.3f}", result.least, result.most), bound,
                           result.pass() ? "pass" : "FAIL");
    }
    return out +
           fmt::format("{} pass, {} FAIL, {} skipped\n", passed, failed, results.size() - passed - failed);
}

} // namespace tandem::bench
