// SPDX-License-Identifier: Apache-2.0
// The figures of the HTML page, drawn by gnuplot as SVG.
#pragma once
#include "apps/bench/report/report.hpp"

namespace tandem::bench {

struct Plot {
    std::string title, svg; ///< "<svg ...>...</svg>"
};

/// Those for which the report has rows. Throws if gnuplot cannot be run.
std::vector<Plot> draw_plots(const Report& report);

} // namespace tandem::bench
