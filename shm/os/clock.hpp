// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>

namespace tandem::shm {

/// CLOCK_MONOTONIC in nanoseconds: one clock for all processes of the machine, no system call.
inline std::uint64_t now_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000ULL +
           static_cast<std::uint64_t>(now.tv_nsec);
}

/// Its ticks are of some length, and it may go back where a thread moves to another core. One instruction.
inline std::uint64_t time_stamp_counter() { return __builtin_ia32_rdtsc(); }

/// No wait of this room is longer; a bound beyond it (or "forever") is cut to it.
constexpr std::chrono::nanoseconds longest_wait = std::chrono::hours(24);

/// A bound in nanoseconds, none negative and none too long.
inline std::uint64_t bounded_ns(std::chrono::nanoseconds bound) {
    return static_cast<std::uint64_t>(
        std::clamp(bound, std::chrono::nanoseconds::zero(), longest_wait).count());
}

/// The point of now_ns() at which a wait of this bound ends.
inline std::uint64_t deadline_after(std::chrono::nanoseconds bound) { return now_ns() + bounded_ns(bound); }

} // namespace tandem::shm
