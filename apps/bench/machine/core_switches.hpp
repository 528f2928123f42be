// SPDX-License-Identifier: Apache-2.0
// Counts how often other threads have taken the core away from a thread, which identifies the disturbed windows
// of a paired case.
#pragma once
#include <cstdint>
#include <sys/resource.h>

namespace tandem::bench {

/// Returns the count of the calling thread.
inline std::uint64_t thread_switches() {
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return static_cast<std::uint64_t>(usage.ru_nivcsw);
}

} // namespace tandem::bench
