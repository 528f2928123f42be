// SPDX-License-Identifier: Apache-2.0
// The switches of both hosts that say how plugins are tried, under one name each.
#pragma once

#include "host/plugin/probe.hpp"

#include <optional>

namespace CLI {
class App;
}

namespace tandem::plugin {

struct ProbeCliOptions {
    bool disabled = false; ///< --no-probe
    double timeout_s = 10; ///< --probe-timeout

    std::optional<ProbeOptions> probe_options() const;
};

void add_probe_options(CLI::App& cli, ProbeCliOptions& switches);

} // namespace tandem::plugin
