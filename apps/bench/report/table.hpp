// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/report/report.hpp"

namespace tandem::bench {

/// The report for a terminal: the machine first, then a line for each row, then what was skipped and why.
std::string table_text(const Report& report);

/// Four significant digits, at most three after the point, no exponent.
std::string figure_text(double value);

} // namespace tandem::bench
