// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace tandem::bench {

/// Calls of operator new in this process so far. The program's operator new is replaced by one that counts.
std::uint64_t allocation_count();

} // namespace tandem::bench
