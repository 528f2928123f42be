// SPDX-License-Identifier: Apache-2.0
// The list of all cases that this build can measure.
#pragma once
#include "apps/bench/harness/case.hpp"

#include <vector>

namespace tandem::bench {

/// A peer without cases in this build or on this machine.
struct SkippedPeer {
    std::string subject, reason;
};

struct Registry {
    std::vector<Case> cases;
    std::vector<SkippedPeer> skipped;

    void add(const Case& entry) { cases.push_back(entry); }
    /// Adds the case and, unless its reader polls, its variants with low-latency idle and on one core: a reader
    /// that never sleeps does not feel the idle state, and on one core it would only wait for its time slice.
    void add_with_conditions(const Case& entry);
};

/// All cases, ordered by comparison key.
Registry all_cases();

} // namespace tandem::bench
