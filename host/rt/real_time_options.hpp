// SPDX-License-Identifier: Apache-2.0
// The real-time options of both hosts, under one name each.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tandem::rt {

struct RealTimeOptions {
    int cpu = -1;            ///< --cpu: for threads that tick; in wait mode same-core for the whole process
    double tick_spin_us = 0; ///< --tick-spin
    std::string wait_mode;   ///< --wait-mode; empty: the bridges' own default
    bool low_latency_idle = false, lock_memory = false, parent_death = false;

    std::chrono::nanoseconds tick_spin() const {
        return std::chrono::nanoseconds(static_cast<std::int64_t>(tick_spin_us * 1e3));
    }
};

void add_real_time_options(CLI::App& cli, RealTimeOptions& options);

/// [main-thread, before there are others: they inherit it] Asks the kernel, sets a timer slack of 1 ns, and
/// hands the wait mode on to the bridges that this host will load, as $TANDEM_WAIT_MODE. Returns a notice of
/// one line for each refusal. Throws std::runtime_error when the options contradict each other.
std::vector<std::string> apply(const RealTimeOptions& options);

} // namespace tandem::rt
