// SPDX-License-Identifier: Apache-2.0
// What `tandem opros new` and `tandem rtm new` have in common.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tandem::command {

using FilesWithText = std::vector<std::pair<std::string, std::string>>; ///< file name, content

/// Throws std::runtime_error if the name cannot be that of a class, a library and files.
void require_identifier(const std::string& name);

/// Makes the folder with these files, or nothing. Throws std::runtime_error if it exists or cannot be made.
void write_new_folder(const std::filesystem::path& folder, const FilesWithText& files);

/// `text` with each @NAME@ replaced.
std::string named(std::string text, const std::string& name);

} // namespace tandem::command
