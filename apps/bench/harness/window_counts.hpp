// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace tandem::bench {

/// Counts of the short windows of a paired case: windows that count, and windows in which a side lost its core
/// to other processes.
struct WindowCounts {
    std::uint64_t kept = 0, dropped = 0;
    /// Time of a message over the floor: the median of the windows that count; over several runs the mean. 0:
    /// unknown.
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
