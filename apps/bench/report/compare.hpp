// SPDX-License-Identifier: Apache-2.0
// Two reports of one machine, before and after a change of the code (--compare).
#pragma once
#include "apps/bench/report/report.hpp"

namespace tandem::bench {

/// A case whose figure differs by more than its noise.
struct Change {
    std::string id, unit;
    double before, after; ///< p50
    double noise;         ///< relative: how far apart the runs of either report are
    bool better;
    double ratio() const { return after / before; }
};

/// The cases of both reports that changed by more than noise, the largest change first. Noise is the spread of
/// either report's runs, at least 5 %, or 15 % where there is one run only (what two runs half an hour apart
/// differ by). And the ranges of the runs must not overlap.
std::vector<Change> significant_changes(const Report& before, const Report& after);

/// One line for each change, for a terminal; says so if the reports are of different machines.
std::string compare_text(const Report& before, const Report& after);

} // namespace tandem::bench
