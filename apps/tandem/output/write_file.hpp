// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>

namespace tandem::command {

/// Replaces the file's content. Throws std::runtime_error with the file and the cause, also for a full disk.
void write_file(const std::filesystem::path& file, const std::string& text);

} // namespace tandem::command
