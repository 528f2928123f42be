// SPDX-License-Identifier: Apache-2.0
// The switches of both hosts that say how plugins are tried, under one name each.
#pragma once

#include "host/plugin/probe.hpp"

#include <optional>

namespace CLI {
class App;
}

namespace tandem::plugin {

struct ProbeSwitches {
    bool off = false;    ///< --no-probe
    double seconds = 10; ///< --probe-timeout

    std::optional<Probe> probe() const;
};

void declare(CLI::App& cli, ProbeSwitches& switches);

} // namespace tandem::plugin
