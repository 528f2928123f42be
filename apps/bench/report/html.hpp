// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/report/acceptance.hpp"

namespace tandem::bench {

/// The whole report as one page that needs nothing else: conditions, bar (if judged), plots, every row.
std::string html_page(const Report& report, const std::vector<AcceptanceResult>& bar);

} // namespace tandem::bench
