// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace tandem::command {

/// A plain-text table: a line of headings, then one line for each row, columns as wide as their widest cell.
/// A column whose heading begins with '>' is aligned to the right; the '>' is not printed.
/// Widths count bytes: cells are expected to be ASCII (see replace_nonprintable()).
class Table {
  public:
    explicit Table(std::vector<std::string> headings);
    /// Missing cells are empty, surplus ones are dropped.
    void add_row(std::vector<std::string> row);
    bool empty() const { return rows_.size() == 1; } ///< no row but the headings
    std::string text() const; ///< all lines without trailing blanks, each with its newline

  private:
    std::vector<bool> right_aligned_;            // by column
    std::vector<std::vector<std::string>> rows_; // the headings are the first
};

} // namespace tandem::command
