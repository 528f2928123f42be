// SPDX-License-Identifier: Apache-2.0
// What the shared memory is held to: ratios within one run, each with its bound.
#pragma once
#include "apps/bench/report/report.hpp"

namespace tandem::bench {

struct AcceptanceLimit {
    std::string operation;
    enum class Comparison { at_most, at_least } comparison;
    double bound;
    std::string over, under; ///< the ratio's cases; no `under`: the figure of `over` itself

    std::string text() const;       ///< "one-way 48 B, polling / cache line"
    bool holds(double value) const; ///< compares as printed: to three digits
};

struct AcceptanceResult {
    AcceptanceLimit line;
    double value = 0, least = 0, most = 0; ///< median, smallest and largest over the runs
    std::string missing;                   ///< why there is no value; empty if there is one
    bool pass() const { return missing.empty() && line.holds(value); }
};

/// Of the cases with these ids: a peer has a line only if it is among them.
std::vector<AcceptanceLimit> acceptance_limits(const std::vector<std::string>& ids);
bool needed_for_acceptance(const std::vector<AcceptanceLimit>& lines, const std::string& id);

std::vector<AcceptanceResult> check_acceptance(const std::vector<AcceptanceLimit>& lines,
                                               const Report& report);
std::string acceptance_text(const std::vector<AcceptanceResult>& results);

} // namespace tandem::bench
