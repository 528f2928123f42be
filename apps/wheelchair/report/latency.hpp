// SPDX-License-Identifier: Apache-2.0
// Computes how long references take from JoystickComp to ControlComp, and whether any was lost.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

/// Of a list of values.
struct Statistics {
    std::size_t samples = 0;
    double average = 0, deviation = 0, min = 0, max = 0; // standard deviation of the sample (n - 1)
};
Statistics statistics(const std::vector<double>& values);

/// The smallest of the values such that `fraction` of them are not above it (nearest rank); 0 if there are
/// none.
double percentile(std::vector<double> values, double fraction);

/// The time from JoystickComp's sending to ControlComp's receiving of each reference [us], in the order
/// received. For real-time runs only, in which both components use CLOCK_MONOTONIC.
std::vector<double> latencies_us(const std::vector<ControlRecord>& control);

/// The 100 samples of the paper's Table 1: those after the first second of data; fewer if the run is shorter.
std::vector<double> table_samples(const std::vector<double>& latencies);

/// Numbers of references.
struct SampleCount {
    long sent = 0, received = 0, lost = 0;
};
/// Counts the references between the first and the last one received: those sent before ControlComp started
/// or after it ended are not lost.
SampleCount count_samples(const std::vector<JoystickRecord>& joystick,
                          const std::vector<ControlRecord>& control);

/// One line of the latency tables.
struct LatencyRow {
    std::string configuration;
    std::vector<double> latencies; // us
    SampleCount samples;
};
/// The paper's Table 1 and a table of percentiles over the whole runs, with one line per configuration; then
/// the difference of the last configuration's median to each other one's.
std::string latency_tables(const std::vector<LatencyRow>& rows);

} // namespace tandem::wheelchair
