// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/report/acceptance.hpp"

namespace tandem::bench {

/// The whole report as one page that loads nothing else: the machine, the acceptance results (if there are any),
/// the plots, and every row. Throws std::runtime_error if gnuplot cannot be run.
std::string html_page(const Report& report, const std::vector<AcceptanceResult>& acceptance);

} // namespace tandem::bench
