// SPDX-License-Identifier: Apache-2.0
// The results of the components' services, as sequences of doubles on the port, and their checks.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "plugins/wheelchair/core/plant/parameters.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

/// Result of limits() of service chair: maximum speed forward, in reverse and in a spin (of the point between the
/// casters) [m/s], maximum lateral acceleration [m/s^2].
struct ChairLimits {
    double forward, reverse, spin, lateral_acceleration;
};

/// Returns the limits in the service's format.
inline std::vector<double> chair_limits() {
    const JoystickParameters p;
    return {p.max_forward, p.max_reverse, p.max_spin, p.lateral_acceleration};
}

/// Returns the result of parameters() of service chair: track, wheelbase, wheel radius [m], mass [kg], bus voltage [V].
inline std::vector<double> chair_parameters() {
    const PlantParameters p;
    return {p.track, p.wheelbase, p.wheel_radius, p.mass, p.bus_voltage};
}

/// Checks the received result of limits(). Throws InputError unless it is four positive numbers.
inline ChairLimits chair_limits_from(const std::vector<double>& v) {
    bool good = v.size() == 4;
    for (double x : v) good = good && std::isfinite(x) && x > 0.0;
    if (!good)
        throw InputError("service chair answered limits() with " + std::to_string(v.size()) +
                         " numbers that are not four positive numbers; connect the port to an HWComp");
    return {v[0], v[1], v[2], v[3]};
}

/// Throws InputError unless the joystick's dead zone [counts] and direction rate [deg/s] are valid.
inline void check_joystick(double dead_zone, double direction_rate) {
    const bool good = std::isfinite(dead_zone) && std::isfinite(direction_rate) && dead_zone >= 0.0 &&
                      dead_zone < JoystickParameters{}.max_count && direction_rate >= 0.0;
    if (!good)
        throw InputError("service joystick answered dead zone " + std::to_string(dead_zone) +
                         ", direction rate " + std::to_string(direction_rate) +
                         "; connect the port to a JoystickComp");
}

} // namespace tandem::wheelchair
