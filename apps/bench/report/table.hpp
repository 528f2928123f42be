// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/report/report.hpp"

namespace tandem::bench {

/// The report for a terminal: the machine first, then a line for each row, then what was skipped and why.
std::string table_text(const Report& report);

/// Four significant digits, at most three after the point, no exponent.
std::string figure_text(double value);

/// What a row that was measured again has brought, in order, "-" where it failed: "measured 3 times: 1.680 1.071 1.083".
std::string measurements_text(const std::vector<double>& values);

/// The rows that count instructions once more, with all that was counted, and the functions if `functions`; empty if
/// there are none.
std::string path_text(const Report& report, bool functions);

} // namespace tandem::bench
