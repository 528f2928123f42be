// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/probe_switches.hpp"

#include <CLI/CLI.hpp>

namespace tandem::plugin {

std::optional<Probe> ProbeSwitches::probe() const {
    if (off) return std::nullopt;
    Probe probe;
    probe.bound = std::chrono::milliseconds(static_cast<long>(seconds * 1000));
    return probe;
}

void declare(CLI::App& cli, ProbeSwitches& switches) {
    cli.add_flag("--no-probe", switches.off, "Load libraries without trying them in a child process first");
    cli.add_option("--probe-timeout", switches.seconds,
                   "Seconds within which a library that is tried must make its components (10)")
        ->check(CLI::Range(0.1, 3600.));
}

} // namespace tandem::plugin
