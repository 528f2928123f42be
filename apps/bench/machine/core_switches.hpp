// SPDX-License-Identifier: Apache-2.0
// How often others have taken the core away from a thread: what tells a disturbed window of a paired case.
#pragma once
#include <cstdint>
#include <sys/resource.h>

namespace tandem::bench {

/// This thread.
inline std::uint64_t thread_switches() {
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return static_cast<std::uint64_t>(usage.ru_nivcsw);
}

} // namespace tandem::bench
