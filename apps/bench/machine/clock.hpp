// SPDX-License-Identifier: Apache-2.0
// The clock of every measurement: the time-stamp counter (rdtsc) if its rate is constant (the kernel calls this
// constant_tsc and nonstop_tsc), otherwise CLOCK_MONOTONIC_RAW. Its unit is the tick.
#pragma once
#include <cstdint>
#include <ctime>
#include <string>

#ifdef __x86_64__
#include <emmintrin.h>
#endif

namespace tandem::bench {

/// [any-thread after calibrate()] Inherited by forked children.
struct Clock {
    static inline bool tsc = false;
    static inline double ns_per_tick = 1.0;

    /// [before any fork] Chooses the clock and measures the counter's rate against CLOCK_MONOTONIC_RAW.
    static void calibrate();
    /// Returns the clock's name for the report: "rdtsc+lfence, 2.300 GHz" or "CLOCK_MONOTONIC_RAW".
    static std::string name();
};

/// Returns the current time in ns of CLOCK_MONOTONIC_RAW.
inline std::uint64_t raw_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC_RAW, &now);
    return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000ULL +
           static_cast<std::uint64_t>(now.tv_nsec);
}

/// Returns the time in ticks. Without the fences, the processor would execute measured instructions before the
/// first reading or after the second.
inline std::uint64_t ticks() {
#ifdef __x86_64__
    if (Clock::tsc) {
        _mm_lfence();
        const std::uint64_t now = __builtin_ia32_rdtsc();
        _mm_lfence();
        return now;
    }
#endif
    return raw_ns();
}

inline double to_ns(std::uint64_t ticks) { return static_cast<double>(ticks) * Clock::ns_per_tick; }
inline std::uint64_t to_ticks(double ns) { return static_cast<std::uint64_t>(ns / Clock::ns_per_tick); }

} // namespace tandem::bench
