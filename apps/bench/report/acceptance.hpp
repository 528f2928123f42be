// SPDX-License-Identifier: Apache-2.0
// The acceptance limits: what Tandem's shared memory and both hosts are held to (--acceptance). Nearly all are
// ratios of two cases of one run, because absolute times belong to one machine and hour.
#pragma once
#include "apps/bench/report/report.hpp"

#include <optional>

namespace tandem::bench {

/// One limit: of the ratio numerator / denominator, or of the numerator's p50 alone.
struct AcceptanceLimit {
    std::string description; ///< "one-way 48 B, polling / cache line"
    enum class Comparison { at_most, at_least } comparison;
    double limit;
    std::string numerator;   ///< the id of a case
    std::string denominator; ///< the id of a case, or empty
    /// Of a paired case: the limit where its floor takes near_floor_ns, as between cores that share a cache;
    /// `limit` is the one from far_floor_ns on, and what is between lies between. The instructions of the road take as long
    /// on both, and a line does not.
    std::optional<double> near_limit = {};
    double near_floor_ns = 80; ///< of a stream, whose lines overlap, less
    static constexpr double far_floor_ns = 150;

    /// The limit where a message over the floor takes so long; the stricter one if that is not known (0). Below near_floor_ns, as
    /// between two threads of one core, the case may take as many ns as there, for the same reason.
    double limit_at(double floor_ns) const;

    /// Whether `value`, rounded to the three digits that are printed, is within the limit.
    bool is_met(double value) const;
};

struct AcceptanceResult {
    AcceptanceLimit limit;              ///< with the limit that holds for these runs
    double value = 0, min = 0, max = 0; ///< median, smallest and largest over the runs
    std::vector<double> values;         ///< of each run, in order; NaN where it failed
    std::size_t measured_again = 0;     ///< how many of them, the last ones, a missed limit caused
    std::string skipped;                ///< why there is no value; empty if there is one
    bool passed() const { return skipped.empty() && limit.is_met(value); }
    bool failed() const { return skipped.empty() && !limit.is_met(value); }
    /// "pass", "FAIL" or the reason why it was skipped; if it was measured again, with each value.
    std::string verdict() const;
};

/// All limits. Each peer that can sleep and is among the cases with these ids has a limit of its own.
std::vector<AcceptanceLimit> acceptance_limits(const std::vector<std::string>& ids);

/// Whether a limit refers to the case with this id.
bool needed_for_acceptance(const std::vector<AcceptanceLimit>& limits, const std::string& id);

/// The limits that the report does not meet, and those of which a case was tried and has no figures. Before that counts, their cases
/// are measured again.
std::vector<AcceptanceLimit> missed_limits(const std::vector<AcceptanceLimit>& limits, const Report& report);

/// The median over the runs of the ratio within each run, so that a drift of the machine between runs cancels
/// out; in the order of the limits.
std::vector<AcceptanceResult> check_acceptance(const std::vector<AcceptanceLimit>& limits,
                                               const Report& report);

/// A table for a terminal: one line for each limit, with its verdict(), then the sums.
std::string acceptance_text(const std::vector<AcceptanceResult>& results);

} // namespace tandem::bench
