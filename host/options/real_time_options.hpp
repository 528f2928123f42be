// SPDX-License-Identifier: Apache-2.0
// The real-time command-line options, which have the same names in both hosts (README.md).
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tandem::options {

/// The parsed values.
struct RealTimeOptions {
    /// --cpu: processor of the ticking threads, and in wait mode same-core of the whole process; -1: any
    int cpu = -1;
    std::optional<double> tick_spin_us; ///< --tick-spin [us]; none: the default of rt::TickOptions
    std::string wait_mode;              ///< --wait-mode; empty: the default of the proxy's components
    bool low_latency_idle = false, lock_memory = false, parent_death = false;

    std::optional<std::chrono::nanoseconds> tick_spin() const {
        if (!tick_spin_us) return std::nullopt;
        return std::chrono::nanoseconds(static_cast<std::int64_t>(*tick_spin_us * 1e3));
    }
};

/// Declares the options. Parsing writes to `options`, which must live as long as `cli`.
void add_real_time_options(CLI::App& cli, RealTimeOptions& options);

/// Requests from the kernel what the options ask for, sets a timer slack of 1 ns, and passes the wait mode to later
/// loaded plugins in $TANDEM_WAIT_MODE. Returns one line for each refused request. Throws std::runtime_error if
/// options contradict each other. [main-thread, before other threads exist: they inherit]
std::vector<std::string> apply(const RealTimeOptions& options);

} // namespace tandem::options
