// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace tandem::bench {

/// [any-thread] Returns how often operator new has been called in this process, by any of its libraries. This
/// file replaces the program's operator new by one that counts.
std::uint64_t allocation_count();

} // namespace tandem::bench
