// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plugins/wheelchair/core/law/signals.hpp"

namespace tandem::wheelchair {

/// Stick positions over time; each holds until the next.
class JoystickRecording {
  public:
    struct Sample {
        double t;
        JoystickPosition position;
    };
    explicit JoystickRecording(std::vector<Sample> samples) : samples_(std::move(samples)) {}

    JoystickPosition at(double t) const; // stick released before the first sample
    double seconds() const { return samples_.empty() ? 0.0 : samples_.back().t; }

  private:
    std::vector<Sample> samples_;
};

/// Reads CSV lines `t, jx, jy, estop` (s, counts -2000..2000, counts, 0 or 1; a heading line and lines that
/// begin with # may be there; t must not fall). Throws InputError `file:line: what is wrong, what is
/// expected`.
JoystickRecording read_joystick_file(const std::string& path);

} // namespace tandem::wheelchair
