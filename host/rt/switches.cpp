// SPDX-License-Identifier: Apache-2.0
#include "host/rt/switches.hpp"

#include "host/rt/thread.hpp"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <sys/prctl.h>

namespace tandem::rt {

void declare(CLI::App& cli, Switches& switches) {
    cli.add_option("--cpu", switches.cpu, "Pin tick threads to this processor");
    cli.add_option("--tick-spin", switches.tick_spin_us,
                   "Poll the last US microseconds before a tick instead of sleeping")
        ->check(CLI::NonNegativeNumber);
    cli.add_option("--wait-mode", switches.wait_mode,
                   "How calls wait for the other host; same-core: both hosts on the processor --cpu")
        ->check(CLI::IsMember({"spin", "spin-then-futex", "futex", "same-core"}));
    cli.add_flag("--low-latency-idle", switches.low_latency_idle, "Keep processors out of deep idle states");
    cli.add_flag("--lock-memory", switches.lock_memory, "Lock the process in memory");
    cli.add_flag("--parent-death", switches.parent_death, "Leave in order when the parent process dies");
}

std::vector<std::string> apply(const Switches& switches) {
    const bool same_core = switches.wait_mode == "same-core";
    if (same_core && switches.cpu < 0)
        throw std::runtime_error("--wait-mode same-core needs --cpu N, the same processor for both hosts");
    std::vector<std::string> notices;
    const auto note = [&](std::optional<std::string> refusal) {
        if (refusal) notices.push_back(std::move(*refusal));
    };
    prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    if (same_core) note(pin_this_thread("the process", switches.cpu));
    if (switches.lock_memory) note(lock_memory());
    if (switches.low_latency_idle) note(hold_low_latency_idle());
    if (switches.parent_death) note(end_with_parent());
    if (!switches.wait_mode.empty()) setenv("TANDEM_WAIT_MODE", switches.wait_mode.c_str(), 1);
    return notices;
}

} // namespace tandem::rt
