// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/plant/steering.hpp"

#include <cmath>

#include "plugins/wheelchair/core/plant/parameters.hpp"

namespace tandem::wheelchair {

double steering_angle_deg(double left, double right) {
    const double mean = 0.5 * (right + left);
    if (std::abs(mean) < min_steering_speed) return 0.0;
    return std::atan(0.5 * (right - left) / (ControlParameters{}.kappa * mean)) * degrees;
}

} // namespace tandem::wheelchair
