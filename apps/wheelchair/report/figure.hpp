// SPDX-License-Identifier: Apache-2.0
// Draws runs with gnuplot.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugins/wheelchair/core/record/rows.hpp"

namespace tandem::wheelchair {

/// Draws steering angle, wheel speeds and voltages of one run to `path` (.svg or .png). Throws InputError
/// when the suffix is another one, or gnuplot is missing or fails.
void draw_run(const std::string& path, const std::string& title, const std::vector<Row>& rows);

/// Draws the paper's Fig. 14: measured steering angles of several configurations, and below them the
/// differences to the first one. Writes `path` and a file of the same name with the other suffix. Throws as
/// draw_run().
void draw_comparison(const std::string& path, const std::string& title,
                     const std::vector<std::pair<std::string, std::vector<Row>>>& runs);

/// Throws InputError unless `path` ends in .svg or .png. To be called before the run, not only after it.
void check_figure_path(const std::string& path);

} // namespace tandem::wheelchair
