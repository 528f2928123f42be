// SPDX-License-Identifier: Apache-2.0
// One row of the report, and the report as a whole; JSON in both directions.
#pragma once
#include "apps/bench/harness/summary.hpp"
#include "apps/bench/harness/tick_record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tandem::bench {

struct Row {
    std::string id, group, subject, operation, wake, regime, placement, detail, unit, cores;
    std::size_t bytes = 0;
    Summary summary;                       ///< median over the runs
    std::vector<double> runs;              ///< p50 of each run, in order; NaN where that run failed
    std::optional<TickCounts> tick_counts; ///< of cases that tick, over all runs
    double foreign_cpu_share = 0;          ///< largest share of the machine that others got during a run
    std::string skipped;                   ///< why there are no figures; empty if there are
    bool higher_is_better() const { return unit != "ns" && unit != "count"; }
    /// A paced message counts from when it was due, so that a stall is not hidden.
    const char* timed_from() const { return operation == "paced" ? "intended start" : "start"; }
    bool disturbed() const { return foreign_cpu_share > 0.02; }
    bool latency() const { return unit == "ns"; }
};

struct Machine {
    std::string kernel, processor, clock, date;
    int cores = 0;
};

struct Report {
    Machine machine;
    std::vector<Row> rows;
    const Row* find(const std::string& id) const; ///< nullptr: no such row, or it has no figures
};

std::string to_json(const Report& report);
Report
from_json(const std::string& text); ///< Throws std::runtime_error, one line, if it is no report of ours.

} // namespace tandem::bench
