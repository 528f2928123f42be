// SPDX-License-Identifier: Apache-2.0
// The chair as a mechanical and electrical system with 13 states (docs/wheelchair.md, section 4).
#pragma once

#include <Eigen/Core>

#include "plugins/wheelchair/core/plant/parameters.hpp"
#include "plugins/wheelchair/core/plant/slope.hpp"

namespace tandem::wheelchair {

/// Indices in State. A caster's angle is relative to the chair (0: it trails). A wheel's angle is not wrapped.
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

/// Inputs of the chair; constant during a call of Plant::integrate().
struct PlantInput {
    double volts_left = 0.0, volts_right = 0.0; // after PWM
    double current_limit = 0.0;                 // A
    bool parking_brake = true;
};

/// Simulates the chair. Not thread-safe; uses no clock.
class Plant {
  public:
    /// `weak_left`, `weak_right`: factors for that side's motor constant; 1 is a healthy motor.
    Plant(const PlantParameters& parameters, double weak_left, double weak_right, const Slope& slope);

    State state = State::Zero();

    /// Advances `state` by `seconds` from time `t`, in Runge-Kutta steps of 1 ms.
    void integrate(double t, double seconds, const PlantInput& input);

    double wheel_speed_left() const;  // rad/s, the true value instead of the encoder's
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
