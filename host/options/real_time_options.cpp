// SPDX-License-Identifier: Apache-2.0
#include "host/options/real_time_options.hpp"

#include "host/options/number_check.hpp"
#include "host/rt/thread.hpp"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <sys/prctl.h>

namespace tandem::options {

void add_real_time_options(CLI::App& cli, RealTimeOptions& options) {
    cli.add_option("--cpu", options.cpu, "Pin tick threads to this processor");
    cli.add_option(
           "--tick-spin", options.tick_spin_us,
           "Poll the last US microseconds before a tick instead of sleeping [100 while messages reach or "
           "leave the component; at most 5 % of the period, and 10 % of a processor for all threads]")
        ->check(nonnegative_number());
    cli.add_option("--wait-mode", options.wait_mode,
                   "How calls wait for the other host (spin-then-futex); same-core: both hosts on the "
                   "processor --cpu")
        ->check(CLI::IsMember({"spin", "spin-then-futex", "futex", "same-core"}));
    cli.add_flag("--low-latency-idle", options.low_latency_idle, "Keep processors out of deep idle states");
    cli.add_flag("--lock-memory", options.lock_memory, "Lock the process in memory");
    cli.add_flag("--parent-death", options.parent_death, "End cleanly when the parent process dies");
}

std::vector<std::string> apply(const RealTimeOptions& options) {
    const bool same_core = options.wait_mode == "same-core";
    if (same_core && options.cpu < 0)
        throw std::runtime_error("--wait-mode same-core needs --cpu N, the same processor for both hosts");
    std::vector<std::string> notices;
    const auto note = [&](std::optional<std::string> refusal) {
        if (refusal) notices.push_back(std::move(*refusal));
    };
    prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    if (same_core) note(rt::pin_this_thread("the process", options.cpu));
    if (options.lock_memory) note(rt::lock_memory());
    if (options.low_latency_idle) note(rt::hold_low_latency_idle());
    if (options.parent_death) note(rt::terminate_with_parent());
    if (!options.wait_mode.empty()) setenv("TANDEM_WAIT_MODE", options.wait_mode.c_str(), 1);
    return notices;
}

} // namespace tandem::options
