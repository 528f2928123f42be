// SPDX-License-Identifier: Apache-2.0
// Measures cases, several times, and makes a report of them.
#pragma once
#include "apps/bench/harness/case_runner.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/report/acceptance.hpp"

namespace tandem::bench {

/// What measure() is to do.
struct Plan {
    std::vector<Case> cases;
    std::vector<SkippedPeer> skipped; ///< only named in the report
    Budget budget;
    Cores cores;
    int runs = 1;
    std::vector<AcceptanceLimit> limits = {}; ///< the cases of those that are missed are measured again
    double pause_seconds = 5;                 ///< before each time that they are
    bool progress = true;                     ///< shows each case as it is measured, on stderr
};

/// [driver] Each run goes through all cases, instead of each case through all runs: the two cases of a ratio are
/// measured within a minute, and a drift of the machine affects all cases alike. A case that fails has its reason
/// in its row. After the runs, the cases of all missed_limits() are measured twice more, which count as two more runs of theirs. Ends
/// early after an interrupt.
Report measure(const Plan& plan);

/// The cases whose id contains one of the patterns (comma-separated); all if there is no pattern.
std::vector<Case> selected(const std::vector<Case>& cases, const std::string& patterns);

/// The conditions of the report, at this moment.
Machine this_machine();

} // namespace tandem::bench
