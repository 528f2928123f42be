// SPDX-License-Identifier: Apache-2.0
// The command-line options for probes, which have the same names in both hosts.
#pragma once

#include "host/plugin/probe.hpp"

#include <optional>

namespace CLI {
class App;
}

namespace tandem::options {

/// The parsed values.
struct ProbeCliOptions {
    bool disabled = false; ///< --no-probe
    double timeout_s = 10; ///< --probe-timeout

    std::optional<plugin::ProbeOptions> probe_options() const; ///< nothing if probes are disabled
};

/// Declares the options. Parsing writes to `options`, which must live as long as `cli`.
void add_library_probe_options(CLI::App& cli, ProbeCliOptions& options);

} // namespace tandem::options
