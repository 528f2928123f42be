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

/// The time from JoystickComp's send of a reference to ControlComp's receive [us].
struct LatencySample {
    double us = 0;
    /// The core of one of the two components was taken for over 20 us in this tick.
    bool disturbed = false;
};
/// Returns a sample of each received reference, in the order received. Only for real-time runs, in which both components
/// use CLOCK_MONOTONIC.
std::vector<LatencySample> latencies(const std::vector<JoystickRecord>& joystick,
                                     const std::vector<ControlRecord>& control);

enum class Samples { all, undisturbed };
/// Returns the latencies [us] of all samples, or only those of the undisturbed ones.
std::vector<double> values_us(const std::vector<LatencySample>& samples, Samples which = Samples::all);

/// Returns the samples after the first second, in which the hosts are still starting; all of them if the run is shorter
/// than two seconds.
std::vector<LatencySample> without_start(const std::vector<LatencySample>& samples);

/// Returns the first 100 of these for the paper's Table 1; fewer if the run is shorter.
std::vector<LatencySample> table_samples(const std::vector<LatencySample>& samples);

/// Numbers of references.
struct SampleCount {
    long sent = 0, received = 0, lost = 0;
};
/// Counts the references from the first received one on. Those sent before ControlComp started, or in its last second and after
/// the last received one, are not lost: hosts stop one after the other.
SampleCount count_samples(const std::vector<JoystickRecord>& joystick,
                          const std::vector<ControlRecord>& control);

/// A line of the latency tables.
struct LatencyRow {
    std::string configuration;
    std::vector<LatencySample> latencies;
    SampleCount samples;
};
/// Returns the paper's Table 1 and a table of percentiles after the first second, with one line per configuration, and the
/// difference of the last configuration's median from each other one. If samples were disturbed, says how many, and
/// repeats both tables without them.
std::string latency_tables(const std::vector<LatencyRow>& rows);

} // namespace tandem::wheelchair
