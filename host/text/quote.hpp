// SPDX-License-Identifier: Apache-2.0
// Quotes text that does not come from this program, so that another language reads it as plain text.
#pragma once

#include <string>

namespace tandem::text {

/// Returns one word of a POSIX shell. Leaves a word without special characters unchanged.
std::string quote_shell(const std::string& word);

/// Returns one argument of CMake's language, in which CMake expands nothing. List separators and generator
/// expressions keep their meaning for the function that gets the argument.
std::string quote_cmake(const std::string& text);

/// Returns a string of gnuplot, in which gnuplot runs no command. Control characters become '?'.
std::string quote_gnuplot(const std::string& text);

/// Returns an identifier or a label of Graphviz's language. Control characters become '?'.
std::string quote_dot(const std::string& text);

} // namespace tandem::text
