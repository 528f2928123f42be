// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::wheelchair {

/// Steering angle [deg] of a bicycle with the chair's wheelbase, from the two wheel speeds [rad/s]: only
/// their ratio matters. 0 where it is not defined (mean below 0.2 rad/s).
double steering_angle_deg(double left, double right);

} // namespace tandem::wheelchair
