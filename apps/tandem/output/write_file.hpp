// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>

namespace tandem::command {

/// Replaces the file's content. Throws std::runtime_error that names the file and the cause; a full disk is noticed.
void write_file(const std::filesystem::path& file, const std::string& text);

} // namespace tandem::command
