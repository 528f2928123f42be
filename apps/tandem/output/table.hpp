// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace tandem::command {

/// A plain-text table: a line of headings, then one line per row. Columns are as wide as their widest cell. Columns
/// whose heading begins with '>' are right-aligned; the '>' is not printed. Widths count bytes, so cells should be
/// ASCII (see replace_nonprintable()).
class Table {
  public:
    explicit Table(std::vector<std::string> headings);
    /// Missing cells become empty; surplus cells are dropped.
    void add_row(std::vector<std::string> row);
    bool empty() const { return rows_.size() == 1; } ///< there is no row besides the headings
    std::string text() const; ///< all lines without trailing blanks, each with a newline

  private:
    std::vector<bool> right_aligned_;            // by column
    std::vector<std::vector<std::string>> rows_; // the first row contains the headings
};

} // namespace tandem::command
