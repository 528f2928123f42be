// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

namespace tandem::command {

/// Returns the first line of a build's output that reports an error of CMake, the compiler, the linker or
/// omniidl; the last line that is not from make if there is none.
std::string first_error(const std::string& output);

/// Returns a build's output with the errors of clang and lld that the following functions understand in the words of g++ and ld.
std::string output_worded_as_gcc(const std::string& output);

/// Returns the missing header in an error line of the compiler; "" for any other line.
std::string missing_header(const std::string& line);

/// Returns the missing file in an error line of omniidl about an #include; "" for any other line.
std::string missing_idl(const std::string& line);

/// Returns the names of all headers that a build's output reports as missing.
std::vector<std::string> missing_headers(const std::string& output);

/// Returns the text between two others; "" if they are missing.
std::string between(const std::string& text, const std::string& before, const std::string& after);

/// Returns the name that the compiler does not know according to an error line; "" for any other line.
std::string unknown_name(const std::string& line);

/// Returns the name in an "undefined reference" line of the linker; "" for any other line.
std::string undefined_symbol(const std::string& line);

/// Returns the names of all functions and variables that a build's output reports as undefined.
std::set<std::string> undefined_symbols(const std::string& output);

} // namespace tandem::command
