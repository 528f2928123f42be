// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reads a CMakeLists.txt without running it, as far as possible.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tandem::command {

using Words = std::vector<std::string>;
using Variables = std::map<std::string, Words>;

/// Expands the variables ${NAME} and $(NAME) in words. A word that is one reference may become several words
/// or none. A word with an unknown variable is omitted.
Words expand(const Words& words, const Variables& variables);

/// Splits text at white space, quotes, ';' and ','.
Words split(std::string text);

/// Returns the file's lines without comments. Joins lines that end with a backslash.
std::vector<std::string> read_lines(const std::filesystem::path& file);

/// Returns the words of each command that lists a target's sources. A pattern (GLOB) becomes unknown_files.
std::vector<Words> read_cmake_targets(const std::filesystem::path& file);
inline const std::string unknown_files = "*";

/// Returns the definitions (NAME or NAME=VALUE) that CMakeLists.txt files add outside of if() and similar
/// blocks: the folder's file and, in a checkout, the files above it.
std::vector<std::string> read_definitions(const std::filesystem::path& folder);

} // namespace tandem::command
