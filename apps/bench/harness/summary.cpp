// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/summary.hpp"

#include <algorithm>
#include <cmath>

namespace tandem::bench {

namespace {

constexpr int points_per_decade = 8;

/// Returns the smallest sample with at least `share` of all samples at or below it.
double percentile(const std::vector<double>& sorted, double share) {
    // 1e-9 less, because a product that rounding left just above a whole number would give the next rank.
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size()) - 1e-9));
    return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

} // namespace

Summary summarize(std::vector<double> samples) {
    Summary out;
    out.samples = samples.size();
    if (samples.empty()) return out;
    std::sort(samples.begin(), samples.end());
    out.p25 = percentile(samples, 0.25);
    out.p75 = percentile(samples, 0.75);
    out.p50 = percentile(samples, 0.5);
    out.p90 = percentile(samples, 0.9);
    out.p99 = percentile(samples, 0.99);
    out.p999 = percentile(samples, 0.999);
    out.max = samples.back();
    for (int i = 0;; ++i) {
        const double rest = std::pow(10.0, -static_cast<double>(i) / points_per_decade);
        if (rest * static_cast<double>(samples.size()) < 1.0) break;
        out.curve.push_back({1.0 - rest, percentile(samples, 1.0 - rest)});
    }
    return out;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

Summary median_of(const std::vector<Summary>& runs) {
    const auto median_over = [&](auto&& value) {
        std::vector<double> all;
        all.reserve(runs.size());
        for (const Summary& run : runs) all.push_back(value(run));
        return median(std::move(all));
    };
    Summary out;
    // The curves of runs with fewer samples are shorter. Only the common points are compared.
    std::size_t points = runs.empty() ? 0 : runs.front().curve.size();
    for (const Summary& run : runs) {
        out.samples += run.samples;
        out.max = std::max(out.max, run.max);
        points = std::min(points, run.curve.size());
    }
    out.p25 = median_over([](const Summary& run) { return run.p25; });
    out.p75 = median_over([](const Summary& run) { return run.p75; });
    out.p50 = median_over([](const Summary& run) { return run.p50; });
    out.p90 = median_over([](const Summary& run) { return run.p90; });
    out.p99 = median_over([](const Summary& run) { return run.p99; });
    out.p999 = median_over([](const Summary& run) { return run.p999; });
    for (std::size_t i = 0; i < points; ++i)
        out.curve.push_back({runs.front().curve[i].share,
                             median_over([i](const Summary& run) { return run.curve[i].value; })});
    return out;
}

} // namespace tandem::bench
