// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>

namespace tandem::shm {

/// Returns CLOCK_MONOTONIC in nanoseconds: one clock for all processes of the machine. Makes no system call.
inline std::uint64_t now_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000ULL +
           static_cast<std::uint64_t>(now.tv_nsec);
}

/// The longest wait of all classes of shm. A longer bound is reduced to it.
constexpr std::chrono::nanoseconds longest_wait = std::chrono::hours(24);

/// Returns the bound in nanoseconds, from 0 to longest_wait.
inline std::uint64_t bounded_ns(std::chrono::nanoseconds bound) {
    return static_cast<std::uint64_t>(
        std::clamp(bound, std::chrono::nanoseconds::zero(), longest_wait).count());
}

/// Returns the value of now_ns() at which a wait with this bound ends.
inline std::uint64_t deadline_after(std::chrono::nanoseconds bound) { return now_ns() + bounded_ns(bound); }

} // namespace tandem::shm
