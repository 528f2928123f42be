// SPDX-License-Identifier: Apache-2.0
// The acceptance limits of Tandem's shared memory and of both hosts (--acceptance). Nearly all are ratios of
// two cases of one run, because absolute times are valid for one machine and one hour.
#pragma once
#include "apps/bench/report/report.hpp"

#include <optional>

namespace tandem::bench {

/// One limit: for the ratio numerator / denominator, or for the numerator's p50 alone.
struct AcceptanceLimit {
    std::string description; ///< "one-way 48 B, polling / cache line"
    enum class Comparison { at_most, at_least } comparison;
    double limit;
    std::string numerator;   ///< the id of a case
    std::string denominator; ///< the id of a case, or empty
    /// For a paired case: the limit if its floor takes near_floor_ns, as between cores that share a cache.
    /// `limit` applies from far_floor_ns on; between the two, the limit is interpolated. The instructions of
    /// the path take equally long on both, but a cache line does not.
    std::optional<double> near_limit = {};
    double near_floor_ns = 80; ///< less for a stream, whose cache lines overlap
    static constexpr double far_floor_ns = 150;

    /// Returns the limit if a message over the floor takes this long; the stricter one if the time is unknown
    /// (0). Below near_floor_ns, as between two threads of one core, the case may take as many ns as at
    /// near_floor_ns, for the reason above.
    double limit_at(double floor_ns) const;

    /// Returns whether `value`, rounded to the three digits that are printed, is within the limit.
    bool is_met(double value) const;
};

struct AcceptanceResult {
    AcceptanceLimit limit;              ///< the limit that applies to these runs
    double value = 0, min = 0, max = 0; ///< median, smallest and largest over the runs
    std::vector<double> values;         ///< one for each run, in order; NaN if the run failed
    std::size_t measured_again = 0; ///< how many of them, the last ones, were added because of a missed limit
    std::string skipped;            ///< why there is no value; empty if there is one
    bool tried_in_vain = false;     ///< a case of Tandem was tried in each run and has no figure
    bool passed() const { return skipped.empty() && limit.is_met(value); }
    bool failed() const { return skipped.empty() && !limit.is_met(value); }
    /// Returns "pass", "FAIL" or the reason why the limit was skipped; with each value if it was measured
    /// again.
    std::string verdict() const;
};

/// Returns true if limits are met, none is missed, and each case of Tandem that was tried has figures: one that crashes, hangs or
/// delivers corrupt messages has none.
bool is_accepted(const std::vector<AcceptanceResult>& results);

/// Returns all limits. Each peer that can sleep and is among the cases with these ids has a separate limit.
std::vector<AcceptanceLimit> acceptance_limits(const std::vector<std::string>& ids);

/// Returns whether a limit refers to the case with this id.
bool needed_for_acceptance(const std::vector<AcceptanceLimit>& limits, const std::string& id);

/// Returns the limits that the report misses, and the limits with a case that was tried and has no figures.
/// Their cases are measured again before the result counts.
std::vector<AcceptanceLimit> missed_limits(const std::vector<AcceptanceLimit>& limits, const Report& report);

/// Returns the median over the runs of the ratio within each run, so that a drift of the machine between runs
/// cancels out; in the order of the limits.
std::vector<AcceptanceResult> check_acceptance(const std::vector<AcceptanceLimit>& limits,
                                               const Report& report);

/// Returns a table for a terminal: one line for each limit, with its verdict(), then the sums.
std::string acceptance_text(const std::vector<AcceptanceResult>& results);

} // namespace tandem::bench
