// SPDX-License-Identifier: Apache-2.0
// Statistics of one case: exact percentiles of all samples, and the curve of the percentile plot.
#pragma once
#include <cstddef>
#include <vector>

namespace tandem::bench {

/// One point of the percentile plot: `share` of the samples lie at or below `value`.
struct CurvePoint {
    double share, value;
};

struct Summary {
    std::size_t samples = 0;
    double p50 = 0, p90 = 0, p99 = 0, p999 = 0, max = 0;
    std::vector<CurvePoint> curve;
};

/// Nearest-rank percentiles; the curve has points at 1 - 10^-x, up to the last that a sample stands for.
Summary summarize(std::vector<double> samples);

double median(std::vector<double> values); ///< 0 of nothing.

/// Median over the runs of each percentile and of the curve; samples add up, max is the largest.
Summary median_of(const std::vector<Summary>& runs);

} // namespace tandem::bench
