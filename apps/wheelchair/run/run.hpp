// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "apps/wheelchair/options.hpp"
#include "apps/wheelchair/report/latency.hpp"
#include "apps/wheelchair/run/host_failure.hpp"
#include "plugins/wheelchair/core/record/rows.hpp"

namespace tandem::wheelchair {

/// The result of one run of one configuration.
struct RunResult {
    Configuration configuration;
    std::string scenario;
    double seconds = 0.0; // planned length of the scenario
    std::vector<Row> rows;
    std::vector<double> latencies; // joystick send -> control receive [us]; empty in lock-step
    SampleCount samples;
    std::vector<HostFailure> host_failures; // hosts that ended in mid-run; already printed
    std::vector<std::string> failures;      // one line each: whatever else went wrong

    bool complete() const; // every tick of the scenario was recorded
};

/// Runs one configuration: starts the hosts, drives the scenario, stops the hosts. Throws InputError (bad
/// input, a host that did not become ready) or Interrupted; what goes wrong later is in the result.
/// [main-thread]
RunResult run(const Options& options, Configuration configuration);

} // namespace tandem::wheelchair
