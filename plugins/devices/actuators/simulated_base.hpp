// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/devices/simulated_device.hpp"

namespace tandem::devices {

/// A base with two wheels (differential drive) that reaches each velocity at once; m, rad, s. Its odometers count 1000
/// pulses per turn of a wheel. `WheelDiameter`: diameter of the wheels; `AxleDistance`: distance between them.
template <typename Class>
class SimulatedBase : public SimulatedDevice<Class> {
  protected:
    void configure() override {
        pulses_per_metre_ = 1000 / (M_PI * std::max(1e-3, this->number_parameter("WheelDiameter", 0.15)));
        half_axle_ = this->number_parameter("AxleDistance", 0.385) / 2;
        position_ = ObjectLocation();
        left_ = right_ = 0;
        set_motion(0, 0, -1);
    }

    /// Advances the base to the current time and calls action().
    template <typename Action>
    int perform_moved(Action action) {
        return this->perform([&](double, double elapsed) {
            advance(elapsed);
            action();
        });
    }
    /// Moves for this time; negative: until the next command.
    void set_motion(double linear, double angular, double seconds) {
        linear_ = linear;
        angular_ = angular;
        seconds_left_ = seconds;
    }
    bool is_moving() const { return linear_ != 0 || angular_ != 0; }
    long left_pulses() const { return std::lround(left_); }
    long right_pulses() const { return std::lround(right_); }

    ObjectLocation position_;

  private:
    /// Advances by this time, or to the end of a limited motion.
    void advance(double elapsed) {
        const bool limited = seconds_left_ >= 0;
        const double moved = limited ? std::min(elapsed, seconds_left_) : elapsed;
        // Moves along the chord of the arc, whose direction is the heading at half of the time.
        position_.x += linear_ * moved * std::cos(position_.theta + angular_ * moved / 2);
        position_.y += linear_ * moved * std::sin(position_.theta + angular_ * moved / 2);
        position_.theta += angular_ * moved;
        left_ += (linear_ - angular_ * half_axle_) * moved * pulses_per_metre_;
        right_ += (linear_ + angular_ * half_axle_) * moved * pulses_per_metre_;
        if (!limited) return;
        seconds_left_ -= moved;
        if (seconds_left_ <= 0) set_motion(0, 0, -1);
    }

    double linear_ = 0, angular_ = 0, seconds_left_ = -1;
    double left_ = 0, right_ = 0, pulses_per_metre_ = 0, half_axle_ = 0;
};

} // namespace tandem::devices
