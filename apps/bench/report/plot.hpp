// SPDX-License-Identifier: Apache-2.0
// The figures of the HTML page, drawn by gnuplot as SVG.
#pragma once
#include "apps/bench/report/report.hpp"

namespace tandem::bench {

struct Plot {
    std::string title;
    std::string svg; ///< "<svg ...>...</svg>"
};

/// The plots for which the report has rows. Throws std::runtime_error if gnuplot cannot be run.
std::vector<Plot> draw_plots(const Report& report);

} // namespace tandem::bench
