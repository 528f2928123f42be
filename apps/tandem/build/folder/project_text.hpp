// SPDX-License-Identifier: Apache-2.0
// What the texts of makefiles and of CMakeLists.txt have in common.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tandem::command {

using Words = std::vector<std::string>;
using Variables = std::map<std::string, Words>;

/// The words with the values of the variables in them, ${NAME} or $(NAME). A word that is one reference may stand for
/// several words or none; with an unknown part the whole word is unknown and left out.
Words expand(const Words& words, const Variables& variables);

/// Words between white space, quotes, ';' and ','.
Words split(std::string text);

/// The file's lines without comments, with those joined that end in a backslash.
std::vector<std::string> read_lines(const std::filesystem::path& file);

} // namespace tandem::command
