// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/check_file.hpp"
#include "apps/tandem/mcap/format/decode.hpp"

#include <fmt/format.h>

namespace tandem::mcap {

/// Collects at most a hundred findings, because a writer can make the same mistake in every record.
class Findings {
  public:
    template <typename... Arguments>
    void error(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        add(true, fmt::format(format, std::forward<Arguments>(arguments)...));
    }
    template <typename... Arguments>
    void warning(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        add(false, fmt::format(format, std::forward<Arguments>(arguments)...));
    }
    /// Adds an error unless the two values are equal.
    template <typename A, typename B>
    void expect_equal(const A& found, const B& expected, const std::string& what) {
        if (!(found == expected)) error("{} is {}, but should be {}", what, found, expected);
    }
    std::vector<Finding> take() { return std::move(findings_); }

  private:
    void add(bool is_error, std::string line) {
        constexpr std::size_t max_lines = 100;
        if (findings_.size() < max_lines)
            findings_.push_back({is_error, std::move(line)});
        else if (findings_.size() == max_lines)
            findings_.push_back({is_error, "... and more"});
        else
            findings_.back().error |= is_error;
    }
    std::vector<Finding> findings_;
};

/// Returns the name of a record for findings.
inline std::string name_of(const RecordView& record) {
    return fmt::format("the {} at byte {}", record_name(record.op), record.offset);
}

} // namespace tandem::mcap
