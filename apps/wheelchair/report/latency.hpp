// SPDX-License-Identifier: Apache-2.0
// How long a reference takes from JoystickComp to ControlComp, and whether any was lost.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

struct Statistics {
    std::size_t samples = 0;
    double average = 0, deviation = 0, min = 0, max = 0; // deviation: of the sample, n - 1
};
Statistics statistics(const std::vector<double>& values);

/// The value below or at which `fraction` of the values lie (nearest rank); 0 when there are none.
double percentile(std::vector<double> values, double fraction);

/// Joystick send -> control receive [us], in the order received; real time only, where both stamp with one
/// clock.
std::vector<double> latencies_us(const std::vector<ControlRecord>& control);

/// The paper's 100 samples: the first ones after one second of data, fewer when there are not as many.
std::vector<double> table_samples(const std::vector<double>& latencies);

struct SampleCount {
    long sent = 0, received = 0, lost = 0;
};
/// References sent and received from the first to the last one received; what lies before ControlComp's start
/// and after its end is no loss.
SampleCount count_samples(const std::vector<JoystickRecord>& joystick,
                          const std::vector<ControlRecord>& control);

struct LatencyRow {
    std::string configuration;
    std::vector<double> latencies; // us
    SampleCount samples;
};
/// The paper's Table 1, and under it percentiles over the whole run; one line per configuration, and what the
/// last one adds to the others.
std::string latency_tables(const std::vector<LatencyRow>& rows);

} // namespace tandem::wheelchair
