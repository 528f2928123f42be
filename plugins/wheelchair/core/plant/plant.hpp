// SPDX-License-Identifier: Apache-2.0
// The chair as a mechanical and electrical system: 13 states, four constant inputs per step, RK4.
#pragma once

#include <Eigen/Core>

#include "plugins/wheelchair/core/plant/parameters.hpp"

namespace tandem::wheelchair {

/// Places in State. Caster angles are those in the chair (0 = trailing), wheel angles count turns unwrapped.
namespace index {
enum : int {
    x,
    y,
    heading,
    speed,
    yaw_rate,
    current_left,
    current_right,
    caster_left,
    caster_left_rate,
    caster_right,
    caster_right_rate,
    wheel_left,
    wheel_right,
    count
};
}

using State = Eigen::Matrix<double, index::count, 1>;

/// What acts on the chair during one integration step.
struct PlantInput {
    double volts_left = 0.0, volts_right = 0.0; // after PWM
    double current_limit = 0.0;                 // A
    bool parking_brake = true;
};

/// Slope of the ground: a ramp from 0 to `degrees` between `start` and `start + duration` seconds.
struct Slope {
    double angle_deg = 0.0, start = 0.0, duration = 1.0;
    double uphill_heading_deg = 0.0;
    bool present = false;
    double angle_at(double t) const;
};

class Plant {
  public:
    /// `weak_left/right` multiply the motor constant of that side (1 = healthy).
    Plant(const PlantParameters& parameters, double weak_left, double weak_right, const Slope& slope);

    State state = State::Zero();

    /// Advances `state` by `seconds` from time `t` in RK4 steps of 1 ms; inputs are constant. [any-thread]
    void integrate(double t, double seconds, const PlantInput& input);

    double wheel_speed_left() const;  // rad/s, the simulated one
    double wheel_speed_right() const; // rad/s
    const PlantParameters& parameters() const { return parameters_; }

  private:
    State derivative(const State& s, const PlantInput& in, double slope) const;
    void step(double t, double h, const PlantInput& input);

    PlantParameters parameters_;
    double drive_left_, drive_right_; // motor constant at the wheel, N m/A = V s/rad
    Slope slope_;
    double uphill_;
};

} // namespace tandem::wheelchair
