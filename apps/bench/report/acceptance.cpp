// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/acceptance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tandem::bench {

namespace {

using Comparison = AcceptanceLimit::Comparison;

constexpr const char* cache_line = "baseline/cache-line/one-way/8/spin";
constexpr const char* minimal_ring = "baseline/index-ring/one-way/64/spin";

const std::vector<std::string>& asleep_regimes() {
    static const std::vector<std::string> regimes{"", "/low-latency-idle", "/same-core"};
    return regimes;
}

/// On one core our mode for it, which yields before it sleeps.
std::string tandem_asleep(const std::string& regime) {
    return (regime == "/same-core" ? "tandem/ring/one-way/64/spin-then-futex"
                                   : "tandem/ring/one-way/64/blocking") +
           regime;
}

void add_one_way(std::vector<AcceptanceLimit>& lines) {
    lines.push_back({"one-way 48 B, polling / cache line", Comparison::at_most, 1.15,
                     "tandem/ring/one-way/48/spin", cache_line});
    lines.push_back({"one-way 64 B, polling / minimal ring", Comparison::at_most, 1.2,
                     "tandem/ring/one-way/64/spin", minimal_ring});
    lines.push_back({"iceoryx take / one-way 64 B, polling", Comparison::at_least, 6,
                     "peer/iceoryx/one-way/64/spin", "tandem/ring/one-way/64/spin"});
    lines.push_back({"one-way 64 B, spin-then-futex, awake / minimal ring", Comparison::at_most, 1.4,
                     "tandem/ring/one-way/64/spin-then-futex", minimal_ring});
    for (const std::string& regime : asleep_regimes())
        lines.push_back({fmt::format("one-way 64 B, asleep, {} / bare futex ring",
                                     regime.empty() ? "halted" : regime.substr(1)),
                         Comparison::at_most, 1.05, tandem_asleep(regime),
                         "baseline/index-ring/one-way/64/blocking" + regime});
}

/// Every peer that can sleep, in the two regimes in which the software shows.
void add_asleep_peers(std::vector<AcceptanceLimit>& lines, const std::vector<std::string>& ids) {
    for (const std::string regime : {"low-latency-idle", "same-core"})
        for (const std::string& id : ids) {
            if (id.rfind("peer/", 0) != 0 || id.find("/one-way/64/blocking") == std::string::npos ||
                !id.ends_with("/" + regime))
                continue;
            const std::string subject = id.substr(5, id.find('/', 5) - 5);
            lines.push_back({fmt::format("{} asleep, {} / ours", subject, regime), Comparison::at_least, 1,
                             id, tandem_asleep("/" + regime)});
        }
}

void add_opros(std::vector<AcceptanceLimit>& lines) {
    lines.push_back({"OPRoS push of a double, ns", Comparison::at_most, 300, "tandem/opros/push/8", ""});
    lines.push_back(
        {"OPRoS push of vector<double>(1000), ns", Comparison::at_most, 1000, "tandem/opros/push/8000", ""});
    lines.push_back(
        {"OPRoS blocking service call, ns", Comparison::at_most, 200, "tandem/opros/local-call/8", ""});
    lines.push_back({"OPRoS event to call-back, low-latency-idle, ns", Comparison::at_most, 10'000,
                     "tandem/opros/event/8/blocking/low-latency-idle", ""});
    lines.push_back({"OPRoS 1 ms tick with tick-spin, late by ns", Comparison::at_most, 1000,
                     "tandem/opros/tick/8/spin", ""});
    lines.push_back({"OPRoS 1 ms tick / cyclictest", Comparison::at_most, 1.5, "tandem/opros/tick/8/blocking",
                     "peer/cyclictest/tick/8/blocking"});
}

void add_rtm(std::vector<AcceptanceLimit>& lines) {
    lines.push_back(
        {"RTM write of TimedLong, ns", Comparison::at_most, 500, "tandem/rtm/write/12/direct", ""});
    lines.push_back(
        {"RTM write of TimedDoubleSeq of 3, ns", Comparison::at_most, 500, "tandem/rtm/write/36/direct", ""});
    lines.push_back({"RTM allocations per 100,000 writes and reads", Comparison::at_most, 0,
                     "tandem/rtm/write-allocations/48/direct", ""});
    lines.push_back({"RTM service call, ns", Comparison::at_most, 500, "tandem/rtm/local-call/8", ""});
    lines.push_back({"RTM 1 ms tick with tick-spin, late by ns", Comparison::at_most, 1000,
                     "tandem/rtm/tick/8/spin", ""});
    lines.push_back({"RTM 1 ms tick / cyclictest", Comparison::at_most, 1.5, "tandem/rtm/tick/8/blocking",
                     "peer/cyclictest/tick/8/blocking"});
}

void add_rest(std::vector<AcceptanceLimit>& lines) {
    lines.push_back({"call, polling / floor pair", Comparison::at_most, 1.5, "tandem/call-queue/call/64/spin",
                     "baseline/ring-pair/call/64/spin"});
    lines.push_back({"iceoryx client/server / call, polling", Comparison::at_least, 5,
                     "peer/iceoryx/call/64/spin", "tandem/call-queue/call/64/spin"});
    lines.push_back(
        {"64 B records, million per second", Comparison::at_least, 40, "tandem/ring/stream/64/spin", ""});
    for (const std::string size : {"1M", "6M"}) {
        const std::string ours = "tandem/ring/stream/" + size + "/spin/loan";
        lines.push_back({size + "iB by loan / zero-copy floor", Comparison::at_least, 0.97, ours,
                         "baseline/index-ring/stream/" + size + "/spin/zero-copy"});
        // Both are at the memory's limit: "not behind" is within the noise of a run.
        lines.push_back({size + "iB by loan / iceoryx", Comparison::at_least, 0.97, ours,
                         "peer/iceoryx/stream/" + size + "/spin/loan"});
    }
    lines.push_back({"1MiB by copy / copying floor", Comparison::at_least, 0.95,
                     "tandem/ring/stream/1M/spin/copy", "baseline/index-ring/stream/1M/spin/copy"});
    for (const std::string direction : {"opros-to-rtm", "rtm-to-opros"})
        lines.push_back({"component to component, " + direction + " / minimal ring", Comparison::at_most, 3,
                         "tandem/bridge/one-way/64/spin/" + direction, minimal_ring});
    lines.push_back({"one-way, 256 ports open, one used / one port", Comparison::at_most, 1.2,
                     "tandem/ring/ports/64/spin-then-futex/256 ports (1 used)",
                     "tandem/ring/ports/64/spin-then-futex/1 port"});
    lines.push_back({"one-way round 256 ports / one port", Comparison::at_most, 1.2,
                     "tandem/ring/ports/64/spin-then-futex/256 ports",
                     "tandem/ring/ports/64/spin-then-futex/1 port"});
    add_opros(lines);
    add_rtm(lines);
    for (const std::string wake : {"spin", "spin-then-futex"}) {
        lines.push_back({"system calls per 100,000 publishes, " + wake, Comparison::at_most, 0,
                         "tandem/ring/publish-system-calls/64/" + wake, ""});
        lines.push_back({"allocations per 100,000 publishes, " + wake, Comparison::at_most, 0,
                         "tandem/ring/publish-allocations/64/" + wake, ""});
    }
}

std::string why_missing(const Report& report, const std::string& id) {
    for (const Row& row : report.rows) // "peer/iceoryx" stands for all of its cases
        if (!row.skipped.empty() && (row.id == id || id.rfind(row.id + "/", 0) == 0)) return row.skipped;
    return "not measured: " + id;
}

} // namespace

std::string AcceptanceLimit::text() const { return operation; }

bool AcceptanceLimit::holds(double value) const {
    const double shown = std::round(value * 1000) / 1000;
    return comparison == Comparison::at_most ? shown <= bound : shown >= bound;
}

std::vector<AcceptanceLimit> acceptance_limits(const std::vector<std::string>& ids) {
    std::vector<AcceptanceLimit> lines;
    add_one_way(lines);
    add_asleep_peers(lines, ids);
    add_rest(lines);
    return lines;
}

bool needed_for_acceptance(const std::vector<AcceptanceLimit>& lines, const std::string& id) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const AcceptanceLimit& line) { return line.over == id || line.under == id; });
}

std::vector<AcceptanceResult> check_acceptance(const std::vector<AcceptanceLimit>& lines,
                                               const Report& report) {
    std::vector<AcceptanceResult> results;
    for (const AcceptanceLimit& line : lines) {
        AcceptanceResult result{line, 0, 0, 0, ""};
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

std::string acceptance_text(const std::vector<AcceptanceResult>& results) {
    std::string out = fmt::format("{:<58} {:>9} {:>19} {:>9}\n", "bar: median of the runs", "measured",
                                  "least .. most", "bound");
    std::size_t passed = 0, failed = 0;
    for (const AcceptanceResult& result : results) {
        const char* sign = result.line.comparison == Comparison::at_most ? "<=" : ">=";
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
