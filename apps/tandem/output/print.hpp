// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace tandem::command {

/// Replaces the file's content as process::write_output() does. Throws std::runtime_error with the file and the cause,
/// for example for a full disk.
void write_file(const std::filesystem::path& file, const std::string& text);

/// Writes text for people to standard output, with '?' for control characters except newlines and tabs. Throws as
/// print_data().
void print_text(const std::string& text);

/// Writes unchanged text, for programs that read it, to standard output and flushes it. Throws std::runtime_error if not
/// everything can be written, for example on a full disk, so that a truncated result does not end with exit code 0.
void print_data(const std::string& text);

/// Prints JSON, indented by two spaces or on one line. Replaces invalid UTF-8 by U+FFFD, and escapes control
/// characters. Throws like print_data().
void print_json(const nlohmann::json& value, bool one_line = false);

} // namespace tandem::command
