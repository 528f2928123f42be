// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace tandem::mcap {

/// Adds a line up to a limit of a hundred lines, because a file can contain a million damaged records.
inline void add_problem(std::vector<std::string>& problems, std::string line) {
    constexpr std::size_t max_lines = 100;
    if (problems.size() < max_lines) problems.push_back(std::move(line));
    if (problems.size() == max_lines) problems.emplace_back("... and more like these");
}

} // namespace tandem::mcap
