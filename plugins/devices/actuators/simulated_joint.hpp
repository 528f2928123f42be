// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::devices {

/// [one thread] The motion of one joint or drive: it moves at its velocity for good, or reaches a position in a
/// given time and stops. Positions in rad or m, velocities per second, as the device class has them.
class SimulatedJoint {
  public:
    /// Only remembered: power moves nothing here.
    void set_power(double power) { power_ = power; }
    void set_velocity(double velocity);
    /// Reaches the position after that time; at once if it is 0.
    void set_position(double position, unsigned long milliseconds);
    void stop();
    /// Moves on by so many seconds.
    void advance(double seconds);

    double power() const { return power_; }
    double velocity() const { return velocity_; }
    double position() const { return position_; }

  private:
    double power_ = 0, velocity_ = 0, position_ = 0;
    double target_ = 0, seconds_left_ = 0; // of set_position(); 0: there is no target
};

} // namespace tandem::devices
