// SPDX-License-Identifier: Apache-2.0
// The answers of the services: the chair's parameters and limits, as sequences of doubles on the port.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "plugins/wheelchair/core/plant/parameters.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

/// Service chair, limits(): m/s forward, backward, turning on the spot (point between the casters), m/s^2
/// sideways.
struct ChairLimits {
    double forward, reverse, spin, lateral_acceleration;
};

inline std::vector<double> chair_limits() {
    const JoystickParameters p;
    return {p.max_forward, p.max_reverse, p.max_spin, p.lateral_acceleration};
}

/// Service chair, parameters(): track, wheelbase, wheel radius [m], mass [kg], bus voltage [V].
inline std::vector<double> chair_parameters() {
    const PlantParameters p;
    return {p.track, p.wheelbase, p.wheel_radius, p.mass, p.bus_voltage};
}

/// Throws InputError unless these are four positive numbers.
inline ChairLimits chair_limits_from(const std::vector<double>& v) {
    bool good = v.size() == 4;
    for (double x : v) good = good && std::isfinite(x) && x > 0.0;
    if (!good)
        throw InputError("service chair answered limits() with " + std::to_string(v.size()) +
                         " numbers that are not four positive ones; connect the port to an HWComp");
    return {v[0], v[1], v[2], v[3]};
}

/// Throws InputError unless the joystick's dead zone [counts] and direction rate [deg/s] make sense.
inline void check_joystick(double dead_zone, double direction_rate) {
    const bool good = std::isfinite(dead_zone) && std::isfinite(direction_rate) && dead_zone >= 0.0 &&
                      dead_zone < JoystickParameters{}.max_count && direction_rate >= 0.0;
    if (!good)
        throw InputError("service joystick answered dead zone " + std::to_string(dead_zone) +
                         ", direction rate " + std::to_string(direction_rate) +
                         "; connect the port to a JoystickComp");
}

} // namespace tandem::wheelchair
