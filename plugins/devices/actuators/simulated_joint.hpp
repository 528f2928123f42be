// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::devices {

/// A drive: it coasts at its velocity, or goes to a position in the time it is given.
class SimulatedJoint {
  public:
    void set_power(double power) { power_ = power; }
    void set_velocity(double velocity);
    /// Milliseconds; 0 is at once.
    void set_position(double position, unsigned long milliseconds);
    void stop();
    /// So many seconds later.
    void advance(double seconds);

    double power() const { return power_; }
    double velocity() const { return velocity_; }
    double position() const { return position_; }

  private:
    double power_ = 0, velocity_ = 0, position_ = 0;
    double target_ = 0, seconds_left_ = 0;
};

} // namespace tandem::devices
