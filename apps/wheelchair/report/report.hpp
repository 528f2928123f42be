// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "apps/wheelchair/options.hpp"
#include "apps/wheelchair/report/acceptance.hpp"
#include "apps/wheelchair/run/run.hpp"

namespace tandem::wheelchair {

/// What was run, and how it is judged.
struct Report {
    std::vector<RunResult> runs;
    std::vector<std::vector<AcceptanceCheck>> acceptance; // one per run; empty where the scenario has none
    std::vector<AcceptanceCheck> pairs;                   // of --compare
    bool lockstep = false;

    bool good() const; // every run clean and complete, every judgement passed
};

Report make_report(std::vector<RunResult> runs, const Options& options);

/// Tables for people; one line per failure is not part of it.
std::string text_of(const Report& report);

/// Writes the figures as JSON; throws InputError when the file cannot be written.
void write_json(const std::string& path, const Report& report);

} // namespace tandem::wheelchair
