// SPDX-License-Identifier: Apache-2.0
#include "host/options/probe_cli_options.hpp"

#include "host/options/number_check.hpp"

#include <CLI/CLI.hpp>

namespace tandem::options {

std::optional<plugin::ProbeOptions> ProbeCliOptions::probe_options() const {
    if (disabled) return std::nullopt;
    plugin::ProbeOptions options;
    options.timeout = std::chrono::milliseconds(static_cast<long>(timeout_s * 1000));
    return options;
}

void add_library_probe_options(CLI::App& cli, ProbeCliOptions& options) {
    cli.add_flag("--no-probe", options.disabled,
                 "Load libraries without trying them in a child process first");
    cli.add_option("--probe-timeout", options.timeout_s, "Time limit for trying a library, in seconds (10)")
        ->check(number_between(0.1, 3600.));
}

} // namespace tandem::options
