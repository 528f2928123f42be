// SPDX-License-Identifier: Apache-2.0
// Statistics of one case: exact percentiles of all samples, and the curve for the percentile plot.
#pragma once
#include <cstddef>
#include <vector>

namespace tandem::bench {

/// One point of the percentile plot: `share` (0 to 1) of the samples are at or below `value`.
struct CurvePoint {
    double share, value;
};

/// In the case's unit.
struct Summary {
    std::size_t samples = 0;
    double p25 = 0, p75 = 0; ///< the quartiles
    double p50 = 0, p90 = 0, p99 = 0, p999 = 0, max = 0;
    std::vector<CurvePoint> curve;
};

/// Percentiles by nearest rank, without interpolation: each is a sample that occurred. The curve has points at
/// shares of 1 - 10^-x, 8 per decade, as far as there are samples for them.
Summary summarize(std::vector<double> samples);

/// Of an even number of values the mean of the middle two; 0 if there are none.
double median(std::vector<double> values);

/// The median over the runs of each percentile and of each point of the curve; sample counts add up, max is the
/// largest of all runs.
Summary median_of(const std::vector<Summary>& runs);

} // namespace tandem::bench
