// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace tandem::bench {

/// Of the short windows of a paired case: those that count, and those in which a side has lost its core to others.
struct WindowCounts {
    std::uint64_t kept = 0, dropped = 0;

    void add(const WindowCounts& other) {
        kept += other.kept;
        dropped += other.dropped;
    }
};

} // namespace tandem::bench
