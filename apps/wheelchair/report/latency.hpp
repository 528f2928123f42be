// SPDX-License-Identifier: Apache-2.0
// Computes the latency of references from JoystickComp to ControlComp, and the number of lost references.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

/// Statistics of a list of values.
struct Statistics {
    std::size_t samples = 0;
    double average = 0, deviation = 0, min = 0, max = 0; // standard deviation of the sample (n - 1)
};
Statistics statistics(const std::vector<double>& values);

/// Returns the smallest value that is not below `fraction` of the values (nearest rank); 0 if there are none.
double percentile(std::vector<double> values, double fraction);

/// Returns the time from JoystickComp's send to ControlComp's receive of each reference [us], in the order received.
/// Only for real-time runs, in which both components use CLOCK_MONOTONIC.
std::vector<double> latencies_us(const std::vector<ControlRecord>& control);

/// Returns the 100 samples of the paper's Table 1, from after the first second; fewer if the run is shorter.
std::vector<double> table_samples(const std::vector<double>& latencies);

/// Numbers of references.
struct SampleCount {
    long sent = 0, received = 0, lost = 0;
};
/// Counts the references between the first and the last received one. References sent before ControlComp started or
/// after it ended are not lost.
SampleCount count_samples(const std::vector<JoystickRecord>& joystick,
                          const std::vector<ControlRecord>& control);

/// A line of the latency tables.
struct LatencyRow {
    std::string configuration;
    std::vector<double> latencies; // us
    SampleCount samples;
};
/// Returns the paper's Table 1 and a table of percentiles over the whole runs, with one line per configuration, and the
/// difference of the last configuration's median from each other one.
std::string latency_tables(const std::vector<LatencyRow>& rows);

} // namespace tandem::wheelchair
