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

/// Computes percentiles by nearest rank, without interpolation: each is a sample that occurred. The curve has
/// points at shares of 1 - 10^-x, 8 per decade, as far as there are samples for them.
Summary summarize(std::vector<double> samples);

/// Returns the mean of the middle two for an even number of values; 0 if there are none.
double median(std::vector<double> values);

/// Returns the median over the runs for each percentile and for each point of the curve. Sample counts add up;
/// max is the largest of all runs.
Summary median_of(const std::vector<Summary>& runs);

} // namespace tandem::bench
