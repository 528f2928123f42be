// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/report/report.hpp"

namespace tandem::bench {

struct Change {
    std::string id, unit;
    double before, after; ///< p50
    double noise;         ///< relative; of both reports' runs
    bool better;
    double ratio() const { return after / before; }
};

/// What changed beyond noise, largest first: by more than the spread of either report's runs (15 % where
/// there is one run only: two runs half an hour apart agree to that; never less than 5 %), and no run of one
/// report lies among those of the other.
std::vector<Change> significant_changes(const Report& before, const Report& after);

std::string compare_text(const Report& before, const Report& after);

} // namespace tandem::bench
