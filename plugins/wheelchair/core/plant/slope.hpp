// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::wheelchair {

/// Slope of the ground: a ramp from 0 to `degrees` between `start` and `start + duration` seconds.
struct Slope {
    double angle_deg = 0.0, start = 0.0, duration = 1.0;
    double uphill_heading_deg = 0.0;
    bool present = false;
    double angle_at(double t) const; // [rad]
};

} // namespace tandem::wheelchair
