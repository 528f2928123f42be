// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tandem::command {

/// Returns the first line of a build's output that reports an error of CMake, the compiler, the linker or
/// omniidl; the last line that is not from make if there is none.
std::string first_error(const std::string& output);

/// Returns the missing header in an error line of the compiler; "" for any other line.
std::string missing_header(const std::string& line);

/// Returns the missing file in an error line of omniidl about an #include; "" for any other line.
std::string missing_idl(const std::string& line);

/// Returns the names of all headers that a build's output reports as missing.
std::vector<std::string> missing_headers(const std::string& output);

} // namespace tandem::command
