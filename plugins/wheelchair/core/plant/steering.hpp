// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::wheelchair {

/// Returns the steering angle [deg] of a bicycle with the chair's wheelbase, from the ratio of the two wheel speeds
/// [rad/s] (docs/wheelchair.md, section 2); 0 for a mean speed below 0.2 rad/s, where it is undefined.
double steering_angle_deg(double left, double right);

} // namespace tandem::wheelchair
