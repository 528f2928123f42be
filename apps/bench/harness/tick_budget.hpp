// SPDX-License-Identifier: Apache-2.0
// How many ticks of 1 ms the periodic cases take: of OPRoS, of RTM, by hand, and of cyclictest the same.
#pragma once
#include "apps/bench/harness/session.hpp"

namespace tandem::bench {

constexpr std::int64_t tick_period_ns = 1'000'000;

/// 15 s of ticks, or 1 s with --quick. A host that takes a guest's core for 40 us each millisecond by its own clock, which was seen to
/// drift by 9 us a second, meets all ticks of one phase for 5 s: less than half of 15 s, so that the median does not see it.
inline int lateness_ticks(const Budget& budget) { return budget.samples >= 50'000 ? 15'000 : 1'000; }
/// 100 s of ticks and 100 ms to start in, or 1 s with --quick: the drift of 100,000 periods.
inline int drift_ticks(const Budget& budget) { return budget.samples >= 50'000 ? 100'100 : 1'000; }

} // namespace tandem::bench
