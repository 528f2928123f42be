// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>

#include <string>

namespace tandem::command {

/// Writes to standard output and flushes it. Throws std::runtime_error if not all of it can be written, for
/// instance because the disk is full: a truncated result must not end with exit code 0.
void print_text(const std::string& text);

/// Prints JSON, indented by two or on one line. Bytes that are not UTF-8 become U+FFFD. Throws as print_text().
void print_json(const nlohmann::json& value, bool one_line = false);

} // namespace tandem::command
