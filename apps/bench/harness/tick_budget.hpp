// SPDX-License-Identifier: Apache-2.0
// How many ticks of 1 ms the periodic cases take: of OPRoS, of RTM, by hand, and of cyclictest the same.
#pragma once
#include "apps/bench/harness/session.hpp"

namespace tandem::bench {

constexpr std::int64_t tick_period_ns = 1'000'000;

/// 10 s of ticks, or 1 s with --quick.
inline int lateness_ticks(const Budget& budget) { return budget.samples >= 50'000 ? 10'000 : 1'000; }
/// 100 s of ticks and 100 ms to start in, or 1 s with --quick: the drift of 100,000 periods.
inline int drift_ticks(const Budget& budget) { return budget.samples >= 50'000 ? 100'100 : 1'000; }

} // namespace tandem::bench
