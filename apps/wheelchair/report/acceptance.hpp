// SPDX-License-Identifier: Apache-2.0
// Checks whether a step20 run meets the figures of docs/wheelchair.md, sections 8 and 10.
#pragma once

#include <string>
#include <vector>

#include "plugins/wheelchair/core/record/rows.hpp"

namespace tandem::wheelchair {

/// A value of a run and its bounds.
struct AcceptanceCheck {
    std::string name, unit;
    double value, min, max; // an infinite bound is open; NaN never passes
    bool pass() const { return value >= min && value <= max; }
};

/// Returns the checks of docs/wheelchair.md, section 8: the response of the steering angle to the step at 5 s. Returns
/// none if `rows` are fewer than those of a complete step20 run.
std::vector<AcceptanceCheck> check_step20(const std::vector<Row>& rows);

/// Difference of two runs in one column.
struct Difference {
    double rms = 0.0, max = 0.0;
};
/// Returns the difference over [from, to] seconds of scenario time; NaN if the runs have no rows there.
Difference difference(const std::vector<Row>& a, const std::vector<Row>& b, double Row::*column, double from,
                      double to);

/// Returns the checks of section 10 for two real-time runs of step20: whether they steer almost the same from 5 s to 10
/// s. `names`: prefix of the checks' names.
std::vector<AcceptanceCheck> check_similar(const std::string& names, const std::vector<Row>& a,
                                           const std::vector<Row>& b);

/// Returns the check of section 10 for two lock-step runs: whether their CSV rows are identical.
std::vector<AcceptanceCheck> check_identical(const std::string& names, const std::vector<Row>& a,
                                             const std::vector<Row>& b);

bool all_pass(const std::vector<AcceptanceCheck>& checks);

/// Returns a table for people, with `pass` or `FAIL` for each check.
std::string acceptance_table(const std::string& title, const std::vector<AcceptanceCheck>& checks);

} // namespace tandem::wheelchair
