// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tandem::command {

/// The first line of a build's output that reports an error (of CMake, the compiler, the linker or omniidl);
/// without one, its last line.
std::string first_error(const std::string& output);

/// The name in an error of the compiler about a header that does not exist; "" in any other line.
std::string missing_header(const std::string& line);

/// The names of all headers that a build's output reports missing.
std::vector<std::string> missing_headers(const std::string& output);

} // namespace tandem::command
