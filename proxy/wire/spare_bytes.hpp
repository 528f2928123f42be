// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace tandem::wire {

/// Memory for messages that are needed for the time of one call, without an allocation for each: a few vectors that this
/// thread has given back. Nested calls get different ones.
/// A vector, if possible with memory. What it holds means nothing. [any-thread]
std::vector<std::byte> take_spare_bytes();
/// Keeps the memory for the next take_spare_bytes() of this thread, unless there is enough of it or it is large.
void give_back(std::vector<std::byte>&& bytes);

} // namespace tandem::wire
