// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::command {

/// The first line of a build's output that reports an error (of CMake, the compiler, the linker or omniidl);
/// without one, its last line.
std::string first_error(const std::string& output);

} // namespace tandem::command
