// SPDX-License-Identifier: Apache-2.0
// Runs cases, several times, and makes rows of them.
#pragma once
#include "apps/bench/harness/case_runner.hpp"
#include "apps/bench/report/report.hpp"

namespace tandem::bench {

struct Plan {
    std::vector<Case> cases;
    std::vector<Skipped> skipped;
    Budget budget;
    Cores cores;
    int runs = 1;
    bool progress = true; ///< each case as it is measured, on stderr
};

/// Every run goes through all cases, so that the two sides of a ratio are measured within the same minute,
/// and a drift of the machine meets all of them.
Report measure(const Plan& plan);

/// The cases whose id contains one of the patterns (comma-separated); all if there is no pattern.
std::vector<Case> selected(const std::vector<Case>& cases, const std::string& patterns);

Machine this_machine();

} // namespace tandem::bench
