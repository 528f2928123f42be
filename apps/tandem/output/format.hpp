// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::command {

/// Rows of cells under headings, columns as wide as needed. A column whose heading begins with '>' is
/// aligned to the right.
class Table {
  public:
    explicit Table(std::vector<std::string> headings);
    void add_row(std::vector<std::string> row);
    bool empty() const { return rows_.size() == 1; }
    std::string text() const; ///< lines, each with its newline

  private:
    std::vector<bool> right_aligned_;
    std::vector<std::vector<std::string>> rows_;
};

std::string format_bytes(std::uint64_t bytes); ///< 640 B, 8.1 MiB
std::string format_duration(std::uint64_t ns); ///< 12 us, 3 ms, 41 s, 3 h
std::string format_age(
    std::uint64_t since_ns); ///< from a point of shm::now_ns() until now; "-" if that is not in the past
std::string user_name(uid_t user);                         ///< the name, or the number if there is none
std::string replace_nonprintable(const std::string& text); ///< bytes that are not printable ASCII become '?'
std::string
replace_control_characters(std::string text); ///< control characters become '?', letters of all scripts stay

void print_text(const std::string& text); ///< throws std::runtime_error when it cannot all be written
void print_json(const nlohmann::json& value,
                bool one_line = false); ///< bytes that are not UTF-8 are replaced

} // namespace tandem::command
