// SPDX-License-Identifier: Apache-2.0
// What programs have written into a file, for pages. All functions return an empty text for a file that cannot be read.
#pragma once
#include <cstddef>
#include <string>

namespace tandem::monitor {

/// Returns the size in bytes.
std::size_t size_of(int file);

/// Returns up to `size` bytes from `begin`, without control characters and as valid UTF-8.
std::string text_in(int file, std::size_t size, std::size_t begin = 0);

/// Returns the last lines, with at most `most` bytes in total.
std::string last_lines(int file, std::size_t most);

} // namespace tandem::monitor
