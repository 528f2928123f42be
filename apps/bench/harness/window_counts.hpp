// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace tandem::bench {

/// Of the short windows of a paired case: those that count, and those in which a side has lost its core to others.
struct WindowCounts {
    std::uint64_t kept = 0, dropped = 0;
    /// A message over the floor, median of the windows that count; of several runs the mean. 0: not known.
    double floor_ns = 0;

    void add(const WindowCounts& other) {
        const auto both = static_cast<double>(kept + other.kept);
        if (both != 0)
            floor_ns =
                (floor_ns * static_cast<double>(kept) + other.floor_ns * static_cast<double>(other.kept)) /
                both;
        kept += other.kept;
        dropped += other.dropped;
    }
};

} // namespace tandem::bench
