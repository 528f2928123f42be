// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace tandem::bench {

/// [any-thread] How often operator new has been called in this process, by any library in it. The program's
/// operator new is replaced by one that counts.
std::uint64_t allocation_count();

} // namespace tandem::bench
