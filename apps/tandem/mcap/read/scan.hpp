// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/contents.hpp"

namespace tandem::mcap {

/// Fills the contents by reading the data section from `begin` on: up to its end, or to where the file is cut or damaged.
/// Returns whether the end of the data (DataEnd or footer) was found. What cannot be read is a line of
/// `contents.problems`.
bool scan(File& file, std::uint64_t begin, Contents& contents);

} // namespace tandem::mcap
