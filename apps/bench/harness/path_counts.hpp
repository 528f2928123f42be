// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace tandem::bench {

/// The cost of one message on one side, counted instruction by instruction (path/). Lines have 64 bytes, pages
/// 4096.
struct PathCounts {
    std::uint32_t instructions = 0;
    std::uint32_t code_lines = 0, code_pages = 0; ///< distinct ones
    std::uint32_t allocations = 0;                ///< calls of malloc() and similar functions
    std::uint32_t locked = 0;                     ///< instructions that lock a cache line
    std::uint32_t system_calls = 0;
};

} // namespace tandem::bench
