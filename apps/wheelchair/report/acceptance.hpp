// SPDX-License-Identifier: Apache-2.0
// The figures by which a step20 run is judged (specification, sections 8 and 10).
#pragma once

#include <string>
#include <vector>

#include "plugins/wheelchair/core/record/rows.hpp"

namespace tandem::wheelchair {

/// One figure against its bounds.
struct AcceptanceCheck {
    std::string name, unit;
    double value, min, max; // min <= value <= max is a pass; NaN never is
    bool pass() const { return value >= min && value <= max; }
};

/// Section 8 over the steering angle from the step at 5 s to the end. Needs the rows of a full step20 run;
/// empty when there are fewer.
std::vector<AcceptanceCheck> check_step20(const std::vector<Row>& rows);

struct Difference {
    double rms = 0.0, max = 0.0;
};
/// Of one column of two runs over [from, to] seconds of scenario time.
Difference difference(const std::vector<Row>& a, const std::vector<Row>& b, double Row::*column, double from,
                      double to);

/// Section 10: whether two real-time runs of step20 steer the same over 5..10 s.
std::vector<AcceptanceCheck> check_similar(const std::string& names, const std::vector<Row>& a,
                                           const std::vector<Row>& b);

/// Section 10: whether two lock-step runs have the same log, byte for byte.
std::vector<AcceptanceCheck> check_identical(const std::string& names, const std::vector<Row>& a,
                                             const std::vector<Row>& b);

bool all_pass(const std::vector<AcceptanceCheck>& checks);
std::string acceptance_table(const std::string& title, const std::vector<AcceptanceCheck>& checks);

} // namespace tandem::wheelchair
