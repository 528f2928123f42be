// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/report/report.hpp"

namespace tandem::bench {

/// The report for a terminal: conditions first, then a line per row, then what was skipped and why.
std::string table_text(const Report& report);

std::string figure_text(double value); ///< Four significant digits, no exponent.

} // namespace tandem::bench
