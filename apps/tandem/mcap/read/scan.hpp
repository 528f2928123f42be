// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/contents.hpp"

namespace tandem::mcap {

/// Reads the data section from `begin` to its end, or to the place where the file is truncated or damaged, into
/// `contents`. Returns whether the end of the data (DataEnd or footer) was found. Adds a line to `contents.problems`
/// for each unreadable part.
bool scan(File& file, std::uint64_t begin, Contents& contents);

} // namespace tandem::mcap
