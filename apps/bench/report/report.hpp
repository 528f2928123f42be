// SPDX-License-Identifier: Apache-2.0
// The report of one measurement: a row for each case, and the machine. It is written and read as JSON.
#pragma once
#include "apps/bench/harness/path_counts.hpp"
#include "apps/bench/harness/summary.hpp"
#include "apps/bench/harness/tick_record.hpp"
#include "apps/bench/harness/window_counts.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tandem::bench {

/// One case over all runs. The words are those of harness/case.hpp.
struct Row {
    std::string id, group, subject, operation, wake, power_profile, placement, detail, unit;
    std::string conditions; ///< of the machine: "normal", or what differs from it (Case::conditions())
    std::string cores;      ///< "0,1": those of A and B
    std::size_t bytes = 0;
    bool loaded = false;
    Summary summary;                ///< medians over the runs
    std::vector<double> runs;       ///< p50 of each run, in order; NaN where that run failed
    std::size_t measured_again = 0; ///< how many of them, the last ones, were added because of a missed limit
    std::optional<TickCounts> tick_counts;     ///< of cases that tick, over all runs
    std::optional<WindowCounts> window_counts; ///< of paired cases, over all runs
    std::optional<PathCounts> path_counts;     ///< of the last run of a case that counts instructions
    std::vector<std::string>
        path_functions;           ///< "118 libc.so.6 malloc": instructions of that run, library, function
    double foreign_cpu_share = 0; ///< the largest share of the machine that others used in a run
    std::string skipped;          ///< why there are no figures; empty if there are

    bool higher_is_better() const { return unit != "ns" && unit != "count" && unit != "ratio"; }
    /// Returns where a sample begins. A paced message counts from when it was due, so that a stall is not
    /// hidden.
    const char* timed_from() const { return operation == "paced" ? "intended start" : "start"; }
    bool is_disturbed() const { return foreign_cpu_share > max_foreign_cpu_share; }
    /// Returns whether the samples are ratios to a floor, measured in alternation with it.
    bool is_paired() const { return unit == "ratio"; }
    bool is_latency() const { return unit == "ns"; }
    /// Returns whether A and B are separate processes, on one core or on two.
    bool has_two_processes() const { return placement == "processes" || placement == "same-core"; }

    /// Share of the machine. If other processes used more, the case is repeated, and its row is marked as
    /// disturbed.
    static constexpr double max_foreign_cpu_share = 0.02;
};

struct Machine {
    std::string kernel, processor, clock, date;
    int cores = 0;
};

struct Report {
    Machine machine;
    std::vector<Row> rows;
    const Row* find(const std::string& id) const; ///< nullptr: there is no such row, or it has no figures
};

/// Returns the report as JSON, one row per line.
std::string to_json(const Report& report);

} // namespace tandem::bench
