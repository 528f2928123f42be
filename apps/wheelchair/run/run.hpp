// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "apps/wheelchair/options.hpp"
#include "apps/wheelchair/report/latency.hpp"
#include "apps/wheelchair/run/host_failure.hpp"
#include "plugins/wheelchair/core/record/rows.hpp"

namespace tandem::wheelchair {

/// The result of a run of one configuration.
struct RunResult {
    Configuration configuration;
    std::string scenario;
    double seconds = 0.0; // planned length of the scenario
    std::vector<Row> rows;
    std::vector<LatencySample> latencies; // empty in lock-step
    SampleCount samples;
    std::vector<HostFailure> host_failures; // hosts that ended during the run; already printed
    std::vector<std::string> failures;      // one line for each other problem

    std::vector<Row> start; // of a long run: its first 20 s, if `rows` are its last minutes

    const std::vector<Row>& first_rows() const { return start.empty() ? rows : start; }
    bool complete() const; // all ticks of the scenario were recorded
};

/// Runs one configuration: starts the hosts, drives the scenario, stops the hosts. Throws InputError (invalid input, or
/// a host that does not become ready) or Interrupted. Returns later problems in the result. [main-thread]
RunResult run(const Options& options, Configuration configuration);

} // namespace tandem::wheelchair
