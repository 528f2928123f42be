// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::wheelchair {

/// The steering angle [deg] that a bicycle of the chair's wheelbase would have, from the ratio of the two
/// wheel speeds [rad/s] (docs/wheelchair.md, section 2). 0 where it is not defined: for a mean speed below
/// 0.2 rad/s.
double steering_angle_deg(double left, double right);

} // namespace tandem::wheelchair
