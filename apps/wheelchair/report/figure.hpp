// SPDX-License-Identifier: Apache-2.0
// Drawings of a run, by gnuplot.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugins/wheelchair/core/record/rows.hpp"

namespace tandem::wheelchair {

/// Steering angle, wheel speeds and voltages of one run into `path` (.svg or .png).
/// Throws InputError when the ending is another, or gnuplot is missing or fails.
void draw_run(const std::string& path, const std::string& title, const std::vector<Row>& rows);

/// The paper's Fig. 14: measured steering angles of several configurations, and under them the differences to
/// the first. Writes `path` (.svg or .png) and its sibling of the other kind.
void draw_comparison(const std::string& path, const std::string& title,
                     const std::vector<std::pair<std::string, std::vector<Row>>>& runs);

/// Throws InputError unless `path` ends in .svg or .png: said before a run, not after it.
void check_figure_path(const std::string& path);

} // namespace tandem::wheelchair
