// SPDX-License-Identifier: Apache-2.0
// Reads a CMakeLists.txt without running it, as far as possible.
#pragma once

#include "apps/tandem/build/folder/project_text.hpp"

namespace tandem::command {

/// Returns the words of each command that lists a target's sources. A pattern (GLOB) becomes unknown_files.
std::vector<Words> read_cmake_targets(const std::filesystem::path& file);
inline const std::string unknown_files = "*";

/// Returns the definitions (NAME or NAME=VALUE) that CMakeLists.txt files add outside of if() and similar
/// blocks: the folder's file and, in a checkout, the files above it.
std::vector<std::string> read_definitions(const std::filesystem::path& folder);

} // namespace tandem::command
