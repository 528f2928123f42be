// SPDX-License-Identifier: Apache-2.0
// Measures cases several times and creates a report.
#pragma once
#include "apps/bench/harness/case_runner.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/report/acceptance.hpp"

namespace tandem::bench {

/// The work of measure().
struct Plan {
    std::vector<Case> cases;
    std::vector<SkippedPeer> skipped; ///< only named in the report
    Budget budget;
    Cores cores;
    int runs = 1;
    std::vector<AcceptanceLimit> limits = {}; ///< if a limit is missed, its cases are measured again
    double pause_seconds = 5;                 ///< before each additional measurement
    bool progress = true;                     ///< shows each case on stderr while it is measured
};

/// [driver] Each run measures all cases once, so the two cases of a ratio are measured within a minute, and a
/// drift of the machine affects all cases equally. The row of a case that fails contains the reason. After
/// the runs, the cases of all missed_limits() are measured twice more, which counts as two more runs. Ends
/// early after an interrupt.
Report measure(const Plan& plan);

/// Returns the cases whose id contains one of the patterns (separated by commas), or all cases without a
/// pattern.
std::vector<Case> selected(const std::vector<Case>& cases, const std::string& patterns);

/// Returns the conditions of the report at this moment.
Machine this_machine();

} // namespace tandem::bench
