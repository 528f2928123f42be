// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace tandem::wire {

/// Returns a vector, if possible with memory that this thread has given back, so that messages needed only during a call
/// cost no allocation. Its content is undefined. Nested calls get different vectors. [any-thread]
std::vector<std::byte> take_spare_bytes();
/// Keeps the memory for the next take_spare_bytes() of this thread, unless it is large or the thread has enough.
void give_back(std::vector<std::byte>&& bytes);

} // namespace tandem::wire
