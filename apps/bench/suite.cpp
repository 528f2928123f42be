// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/suite.hpp"

#include "apps/bench/harness/daemon.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <sstream>
#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

namespace tandem::bench {

namespace {

std::string cores_text(const Case& bench_case, const Cores& cores) {
    if (bench_case.placement == Placement::alone) return std::to_string(cores.a);
    return fmt::format("{},{}", cores.a, bench_case.regime == Regime::same_core ? cores.a : cores.b);
}

Row empty_row(const Case& bench_case, const Cores& cores) {
    Row row;
    row.id = bench_case.id();
    row.group = name_of(bench_case.group);
    row.subject = bench_case.subject;
    row.operation = bench_case.operation;
    row.bytes = bench_case.bytes;
    row.wake = name_of(bench_case.wake);
    row.regime = name_of(bench_case.regime);
    row.placement = name_of(bench_case.placement);
    row.detail = bench_case.detail;
    row.unit = name_of(bench_case.unit);
    row.cores = cores_text(bench_case, cores);
    return row;
}

constexpr double max_foreign_cpu_share = 0.02; // of the machine: then the case was disturbed

/// Repeated after a pause while others use the machine; the least disturbed attempt counts.
Outcome measure_undisturbed(const Case& bench_case, const Plan& plan) {
    Outcome best = run_case(bench_case, plan.budget, plan.cores);
    const int attempts =
        bench_case.extra_seconds > 0 ? 1 : plan.budget.attempts; // such a case averages by itself
    for (int i = 1; i < attempts && best.foreign_cpu_share > max_foreign_cpu_share && !interrupted(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        Outcome again = run_case(bench_case, plan.budget, plan.cores);
        if (again.failure.empty() &&
            (again.foreign_cpu_share < best.foreign_cpu_share || !best.failure.empty()))
            best = again;
    }
    return best;
}

/// One case of one run; what failed stands in the outcome.
Outcome measure_once(const Case& bench_case, const Plan& plan) {
    Outcome outcome;
    outcome.failure = unmet_requirement(bench_case, plan.cores);
    if (!outcome.failure.empty()) return outcome;
    try {
        const Daemon service(bench_case.service);
        return measure_undisturbed(bench_case, plan);
    } catch (const std::exception& failure) {
        outcome.failure = failure.what();
    }
    return outcome;
}

void finish_row(Row& row, const std::vector<Summary>& summaries, const std::string& failure) {
    row.summary = median_of(summaries);
    if (summaries.empty()) row.skipped = failure.empty() ? "not measured" : failure;
}

} // namespace

std::vector<Case> selected(const std::vector<Case>& cases, const std::string& patterns) {
    if (patterns.empty()) return cases;
    std::vector<Case> out;
    for (const Case& entry : cases) {
        std::istringstream list(patterns);
        for (std::string pattern; std::getline(list, pattern, ',');)
            if (!pattern.empty() && entry.id().find(pattern) != std::string::npos) {
                out.push_back(entry);
                break;
            }
    }
    return out;
}

Machine this_machine() {
    Machine machine;
    utsname name{};
    uname(&name);
    machine.kernel = fmt::format("{} {} {}", name.sysname, name.release, name.machine);
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; machine.processor.empty() && std::getline(info, line);)
        if (line.rfind("model name", 0) == 0) machine.processor = line.substr(line.find(':') + 2);
    machine.cores = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
    machine.clock = Clock::name();
    const std::time_t now = std::time(nullptr);
    char date[32] = "";
    std::strftime(date, sizeof date, "%Y-%m-%d %H:%M:%S", std::localtime(&now));
    machine.date = date;
    return machine;
}

Report measure(const Plan& plan) {
    Report report;
    report.machine = this_machine();
    std::vector<std::vector<Summary>> summaries(plan.cases.size());
    std::vector<std::string> failures(plan.cases.size());
    for (const Case& entry : plan.cases) report.rows.push_back(empty_row(entry, plan.cores));
    for (int run = 0; run < plan.runs; ++run) {
        for (std::size_t i = 0; i < plan.cases.size() && !interrupted(); ++i) {
            if (plan.progress)
                fmt::print(stderr, "\r\033[K[run {}/{}, {}/{}] {}", run + 1, plan.runs, i + 1,
                           plan.cases.size(), report.rows[i].id);
            Outcome outcome = measure_once(plan.cases[i], plan);
            if (outcome.failure.empty()) {
                summaries[i].push_back(summarize(std::move(outcome.samples)));
                report.rows[i].runs.push_back(summaries[i].back().p50);
                if (outcome.tick_counts) {
                    if (!report.rows[i].tick_counts) report.rows[i].tick_counts.emplace();
                    report.rows[i].tick_counts->add(*outcome.tick_counts);
                }
                report.rows[i].foreign_cpu_share =
                    std::max(report.rows[i].foreign_cpu_share, outcome.foreign_cpu_share);
            } else {
                failures[i] = outcome.failure;
                report.rows[i].runs.push_back(NAN);
            }
        }
    }
    if (plan.progress) fmt::print(stderr, "\r\033[K");
    for (std::size_t i = 0; i < plan.cases.size(); ++i)
        finish_row(report.rows[i], summaries[i], interrupted() ? "interrupted" : failures[i]);
    for (const Skipped& skipped : plan.skipped) {
        Row row;
        row.id = "peer/" + skipped.subject;
        row.group = "peer";
        row.subject = skipped.subject;
        row.skipped = skipped.reason;
        report.rows.push_back(row);
    }
    return report;
}

} // namespace tandem::bench
