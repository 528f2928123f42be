// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/report/report.hpp"

namespace tandem::bench {

/// Returns the report for a terminal: the machine, then a line for each row, then the skipped rows with the
/// reasons.
std::string table_text(const Report& report);

/// Returns a number with four significant digits, at most three after the point, and no exponent.
std::string figure_text(double value);

/// Returns the results of a row that was measured again, in order, with "-" for a failure: "measured 3 times:
/// 1.680 1.071 1.083".
std::string measurements_text(const std::vector<double>& values);

/// Returns the rows that count instructions, with all counts, and with the functions if `functions` is set;
/// empty if there are none.
std::string path_text(const Report& report, bool functions);

} // namespace tandem::bench
