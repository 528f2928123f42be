// SPDX-License-Identifier: Apache-2.0
// Runs one case in fresh processes.
#pragma once
#include "apps/bench/harness/session.hpp"
#include "apps/bench/machine/cores.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tandem::bench {

struct Outcome {
    std::vector<double> samples; ///< in the case's unit
    std::string failure;         ///< one line; empty on success
    std::optional<TickCounts> tick_counts;
    std::optional<WindowCounts> window_counts;
    std::optional<PathCounts> path_counts;
    std::vector<std::string> path_functions;
    double foreign_cpu_share = 0; ///< share of the machine that other processes used, 0 to 1
};

/// [driver] Forks side A, pinned to core a, and side B, pinned to core b, and waits for both, up to the
/// budget's timeout. The driver itself never initializes middleware, so no case inherits threads or sockets of
/// another. Leaves no process and no file in /dev/shm, whatever the case does.
Outcome run_case(const Case& bench_case, const Budget& budget, const Cores& cores);

} // namespace tandem::bench
