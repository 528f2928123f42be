// SPDX-License-Identifier: Apache-2.0
// What programs have written into a file, for pages. All functions return an empty text for a file that cannot be read.
#pragma once
#include <cstddef>
#include <string>

namespace tandem::monitor {

/// Returns the size in bytes.
std::size_t size_of(int file);

/// Returns so many bytes from `begin`, without control characters and as valid UTF-8.
std::string text_in(int file, std::size_t size, std::size_t begin = 0);

/// Returns the last lines, at most so many bytes of them.
std::string last_lines(int file, std::size_t most);

} // namespace tandem::monitor
