// SPDX-License-Identifier: Apache-2.0
// The number of ticks of 1 ms that the periodic cases take: the same for OPRoS, RTM, hand-written code and
// cyclictest.
#pragma once
#include "apps/bench/harness/session.hpp"

namespace tandem::bench {

constexpr std::int64_t tick_period_ns = 1'000'000;

/// 15 s of ticks, or 1 s with --quick. A hypervisor was seen to take a guest's core for 40 us in each
/// millisecond of its own clock, which drifted by 9 us a second. It meets all ticks of one phase for 5 s, less
/// than half of 15 s, so the median does not change.
inline int lateness_ticks(const Budget& budget) { return budget.samples >= 50'000 ? 15'000 : 1'000; }
/// 100 s of ticks and 100 ms to start, or 1 s with --quick: the drift over 100,000 periods.
inline int drift_ticks(const Budget& budget) { return budget.samples >= 50'000 ? 100'100 : 1'000; }

} // namespace tandem::bench
