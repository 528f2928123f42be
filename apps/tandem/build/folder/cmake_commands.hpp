// SPDX-License-Identifier: Apache-2.0
// The words of CMake's language, and of makefiles, without running them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tandem::command {

using Words = std::vector<std::string>;
using Variables = std::map<std::string, Words>;

/// A command of a CMake file: its name in lower case, and the text between its parentheses.
struct CMakeCommand {
    std::string name, text;
};

/// Returns the commands of a CMake file; none if it cannot be read.
std::vector<CMakeCommand> read_commands(const std::filesystem::path& file);

/// Expands the variables ${NAME} and $(NAME) in words. A word that is one reference may become several words
/// or none. A word with an unknown variable is omitted, and so is what goes beyond 1 MiB.
Words expand(const Words& words, const Variables& variables);

/// Splits text at white space, quotes, ';' and ','.
Words split(std::string text);

/// Returns the file's lines without comments. Joins lines that end with a backslash.
std::vector<std::string> read_lines(const std::filesystem::path& file);

} // namespace tandem::command
