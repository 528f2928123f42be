// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plugins/wheelchair/core/law/signals.hpp"

namespace tandem::wheelchair {

/// Stick positions over time. Each lasts until the next one.
class JoystickRecording {
  public:
    struct Sample {
        double t;
        JoystickPosition position;
    };
    explicit JoystickRecording(std::vector<Sample> samples) : samples_(std::move(samples)) {}

    JoystickPosition at(double t) const; // released before the first sample
    double seconds() const { return samples_.empty() ? 0.0 : samples_.back().t; }

  private:
    std::vector<Sample> samples_;
};

/// Reads a CSV file with lines `t, jx, jy, estop`: seconds (not decreasing), two counts from -2000 to 2000, 0 or 1.
/// Skips a heading line, blank lines and lines that begin with #. Throws InputError with file and line.
JoystickRecording read_joystick_file(const std::string& path);

} // namespace tandem::wheelchair
