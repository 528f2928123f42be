// SPDX-License-Identifier: Apache-2.0
// Draws runs with gnuplot.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugins/wheelchair/core/record/rows.hpp"

namespace tandem::wheelchair {

/// Draws steering angle, wheel speeds and voltages of a run to `path` (.svg or .png). Throws InputError for another
/// suffix, or if gnuplot is missing or fails.
void draw_run(const std::string& path, const std::string& title, const std::vector<Row>& rows);

/// Draws the paper's Fig. 14: measured steering angles of several configurations, and below them the differences from
/// the first one. Writes `path` and a file with the same name and the other suffix. Throws like draw_run().
void draw_comparison(const std::string& path, const std::string& title,
                     const std::vector<std::pair<std::string, std::vector<Row>>>& runs);

/// Throws InputError unless `path` ends in .svg or .png. Call this before the run.
void check_figure_path(const std::string& path);

} // namespace tandem::wheelchair
