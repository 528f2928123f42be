// SPDX-License-Identifier: Apache-2.0
// The list of all cases that this build can measure.
#pragma once
#include "apps/bench/harness/case.hpp"

#include <vector>

namespace tandem::bench {

/// A peer that this build or this machine cannot measure.
struct SkippedPeer {
    std::string subject, reason;
};

struct Registry {
    std::vector<Case> cases;
    std::vector<SkippedPeer> skipped;

    void add(const Case& entry) { cases.push_back(entry); }
    /// Adds the case and, unless its reader polls, its variants with low-latency idle and on one core. The idle
    /// state does not affect a reader that never sleeps, and on one core such a reader would only wait for its
    /// time slice.
    void add_with_conditions(const Case& entry);
};

/// Returns all cases, ordered by comparison key.
Registry all_cases();

} // namespace tandem::bench
