// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::command {

Table::Table(std::vector<std::string> headings) {
    for (auto& heading : headings) {
        right_aligned_.push_back(!heading.empty() && heading.front() == '>');
        if (right_aligned_.back()) heading.erase(0, 1);
    }
    rows_.push_back(std::move(headings));
}

void Table::add_row(std::vector<std::string> row) {
    row.resize(right_aligned_.size());
    rows_.push_back(std::move(row));
}

std::string Table::text() const {
    std::vector<std::size_t> width(right_aligned_.size());
    for (const auto& row : rows_)
        for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    std::string text;
    for (const auto& row : rows_) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i)
            line += right_aligned_[i] ? fmt::format("{:>{}}  ", row[i], width[i])
                                      : fmt::format("{:<{}}  ", row[i], width[i]);
        // No trailing blanks, so that copied output equals the printed one.
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + '\n';
    }
    return text;
}

} // namespace tandem::command
