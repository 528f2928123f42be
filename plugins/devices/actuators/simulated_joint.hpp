// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::devices {

/// The motion of a joint or drive: it moves at its velocity indefinitely, or reaches a position in a given time and
/// stops. Units are those of the device class: rad or m, and velocities per second. [one thread]
class SimulatedJoint {
  public:
    /// Only stores the power, which moves nothing here.
    void set_power(double power) { power_ = power; }
    void set_velocity(double velocity);
    /// Moves to the position within this time; 0: at once. Units: those of the device class.
    void set_position(double position, unsigned long milliseconds);
    void stop();
    /// Advances the motion by this time.
    void advance(double seconds);

    double power() const { return power_; }
    double velocity() const { return velocity_; }
    double position() const { return position_; }

  private:
    double power_ = 0, velocity_ = 0, position_ = 0;
    double target_ = 0, seconds_left_ = 0; // from set_position(); 0: no target
};

} // namespace tandem::devices
