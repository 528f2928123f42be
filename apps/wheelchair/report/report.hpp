// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "apps/wheelchair/options.hpp"
#include "apps/wheelchair/report/acceptance.hpp"
#include "apps/wheelchair/run/run.hpp"

namespace tandem::wheelchair {

/// The results of all runs of one program call, and their checks.
struct Report {
    std::vector<RunResult> runs;
    std::vector<std::vector<AcceptanceCheck>>
        acceptance;                     // one list per run; empty if its scenario has no checks
    std::vector<AcceptanceCheck> pairs; // for --compare: the last run against each other one
    bool lockstep = false;

    bool good() const; // all runs are complete and without failures, and all checks pass
};

/// Performs the checks that apply to these runs.
Report make_report(std::vector<RunResult> runs, const Options& options);

/// Returns tables for people, without RunResult::failures.
std::string text_of(const Report& report);

/// Writes the report as JSON. Throws InputError if the file cannot be written.
void write_json(const std::string& path, const Report& report);

} // namespace tandem::wheelchair
