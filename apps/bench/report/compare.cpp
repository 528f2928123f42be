// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/compare.hpp"

#include "apps/bench/report/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tandem::bench {

namespace {

// What two runs of one program differ by on an idle machine, at least; and what two single runs differ by.
constexpr double min_noise = 0.05, noise_of_one_run = 0.15;

/// Sorted, without the failed ones.
std::vector<double> measured_runs(const Row& row) {
    std::vector<double> runs;
    for (double run : row.runs)
        if (std::isfinite(run)) runs.push_back(run);
    std::sort(runs.begin(), runs.end());
    return runs;
}

/// The spread of sorted runs, relative to their median.
double noise_of(const std::vector<double>& runs) {
    if (runs.size() < 2) return noise_of_one_run;
    const double middle = median(runs);
    return middle > 0 ? (runs.back() - runs.front()) / middle : 0;
}

/// Whether the ranges of two sorted lists have a common value.
bool overlap(const std::vector<double>& a, const std::vector<double>& b) {
    return !a.empty() && !b.empty() && a.front() <= b.back() && b.front() <= a.back();
}

} // namespace

std::vector<Change> significant_changes(const Report& before, const Report& after) {
    std::vector<Change> out;
    for (const Row& row : after.rows) {
        const Row* old = before.find(row.id);
        if (old == nullptr || !row.skipped.empty() || old->summary.p50 <= 0 || row.summary.p50 <= 0) continue;
        const auto runs = measured_runs(row), old_runs = measured_runs(*old);
        const double noise = std::max({min_noise, noise_of(runs), noise_of(old_runs)});
        const double ratio = row.summary.p50 / old->summary.p50;
        if (std::max(ratio, 1 / ratio) <= 1 + noise || overlap(runs, old_runs)) continue;
        out.push_back({row.id, row.unit, old->summary.p50, row.summary.p50, noise,
                       row.higher_is_better() ? ratio > 1 : ratio < 1});
    }
    // By the logarithm: half is as large a change as double.
    std::stable_sort(out.begin(), out.end(), [](const Change& a, const Change& b) {
        return std::abs(std::log(a.ratio())) > std::abs(std::log(b.ratio()));
    });
    return out;
}

std::string compare_text(const Report& before, const Report& after) {
    std::string out = fmt::format("compared with {} ({})\n", before.machine.date, before.machine.kernel);
    if (before.machine.processor != after.machine.processor || before.machine.cores != after.machine.cores)
        out += fmt::format(
            "measured on another machine: {}, {} cores; only ratios within one report are comparable\n",
            before.machine.processor, before.machine.cores);
    const auto found = significant_changes(before, after);
    // How many rows were compared tells whether "nothing changed" means anything.
    std::size_t common = 0;
    for (const Row& row : after.rows) common += row.skipped.empty() && before.find(row.id) != nullptr ? 1 : 0;
    for (const Change& change : found)
        out += fmt::format("{:<7} {:<60} {:>9} -> {:>9} {:<5} x {:.2f} (noise {:.0f} %)\n",
                           change.better ? "better" : "WORSE", change.id, figure_text(change.before),
                           figure_text(change.after), change.unit, change.ratio(), change.noise * 100);
    return out + fmt::format("{} of {} common rows changed beyond noise\n", found.size(), common);
}

} // namespace tandem::bench
