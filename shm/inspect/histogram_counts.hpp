// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/segment/histogram.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tandem::shm {

/// A private copy of the counts of a layout::Histogram.
struct HistogramCounts {
    std::array<std::uint64_t, layout::Histogram::buckets> counts{};

    std::uint64_t total() const {
        std::uint64_t sum = 0;
        for (const auto count : counts) sum += count;
        return sum;
    }

    /// Returns the duration in ns that a share p (0 to 1) of the durations does not exceed, or 0 without durations. It is
    /// the end of a bucket, so at most a quarter too long; for the last bucket, which has no end, its beginning.
    std::uint64_t percentile(double p) const {
        const auto wanted = static_cast<std::uint64_t>(std::ceil(p * static_cast<double>(total())));
        std::uint64_t seen = 0;
        for (std::size_t bucket = 0; bucket < counts.size(); ++bucket) {
            seen += counts[bucket];
            if (seen != 0 && seen >= wanted)
                return layout::Histogram::lower_bound_of(std::min(bucket + 1, counts.size() - 1));
        }
        return 0;
    }
};

} // namespace tandem::shm
