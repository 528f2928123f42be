// SPDX-License-Identifier: Apache-2.0
// What a CMakeLists.txt says, as far as it can be read without running it.
#pragma once

#include "apps/tandem/build/folder/project_text.hpp"

namespace tandem::command {

/// The words of the commands that list a target's sources. One of them is unknown_files for a pattern (GLOB).
std::vector<Words> read_cmake_targets(const std::filesystem::path& file);
inline const std::string unknown_files = "*";

/// The preprocessor definitions (NAME or NAME=VALUE) that the folder's CMakeLists.txt and, in a checkout, those above it
/// add outside of if() and the like.
std::vector<std::string> read_definitions(const std::filesystem::path& folder);

} // namespace tandem::command
