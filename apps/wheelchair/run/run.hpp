// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "apps/wheelchair/options.hpp"
#include "apps/wheelchair/report/latency.hpp"
#include "apps/wheelchair/run/host_failure.hpp"
#include "plugins/wheelchair/core/record/rows.hpp"

namespace tandem::wheelchair {

/// What one run of one configuration gave.
struct RunResult {
    Configuration configuration;
    std::string scenario;
    double seconds = 0.0; // planned
    std::vector<Row> rows;
    std::vector<double> latencies; // us, empty in lock-step
    SampleCount samples;
    std::vector<HostFailure> host_failures; // hosts that died; told when it happened
    std::vector<std::string> failures;      // one line each: what else was wrong

    bool complete() const; // every tick is there
};

/// Runs one configuration from start to end. Throws InputError (bad input, a host that never came) or
/// Interrupted.
RunResult run(const Options& options, Configuration configuration);

} // namespace tandem::wheelchair
