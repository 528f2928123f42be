// SPDX-License-Identifier: Apache-2.0
// Runs one case in two fresh processes, forked from a driver that never initialises a middleware, A pinned to
// core a and B to core b. Bounded; leaves no process and no file in /dev/shm, whatever the case does.
#pragma once
#include "apps/bench/harness/power_profile.hpp"
#include "apps/bench/harness/session.hpp"

#include <optional>

namespace tandem::bench {

struct Outcome {
    std::vector<double> samples;
    std::string failure; ///< one line; empty if it went well
    std::optional<TickCounts> tick_counts;
    double foreign_cpu_share = 0; ///< share of the machine that other processes got meanwhile, 0 to 1
};

Outcome run_case(const Case& bench_case, const Budget& budget, const Cores& cores);

/// Ctrl-C and SIGTERM end the case that runs; interrupted() tells.
void catch_interrupts();
bool interrupted();

} // namespace tandem::bench
