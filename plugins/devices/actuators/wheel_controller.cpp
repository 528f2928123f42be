// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/simulated_device.hpp"

#include <device/WheelController.h>

namespace {

/// A base with two wheels (differential drive) that reaches each velocity at once; m, rad, s. Its odometers count 1000
/// pulses per turn of a wheel. `WheelDiameter`: diameter of the wheels; `AxleDistance`: distance between them.
class SimulatedWheelController : public tandem::devices::SimulatedDevice<WheelController> {
  public:
    /// Corrects the position, as after localization. The base does not move.
    int SetPosition(ObjectLocation position) override {
        return perform_moved([&] { position_ = position; });
    }
    int GetPosition(ObjectLocation& position) override {
        return perform_moved([&] { position = position_; });
    }
    int GetOdometery(std::vector<long>& pulses) override {
        return perform_moved([&] { pulses = {std::lround(left_), std::lround(right_)}; });
    }
    /// Drives until the next command.
    int DriveWheel(double linear, double angular) override {
        return perform_moved([&] { set_motion(linear, angular, -1); });
    }
    /// The sign of the distance determines the direction; that of the velocity is ignored.
    int MoveWheel(double distance, double linear) override {
        if (linear == 0) return API_ERROR;
        return perform_moved(
            [&] { set_motion(std::copysign(linear, distance), 0, std::fabs(distance / linear)); });
    }
    int RotateWheel(double angle, double angular) override {
        if (angular == 0) return API_ERROR;
        return perform_moved(
            [&] { set_motion(0, std::copysign(angular, angle), std::fabs(angle / angular)); });
    }
    int StopWheel() override {
        return perform_moved([&] { set_motion(0, 0, -1); });
    }
    int IsWheelRunning(bool& running) override {
        return perform_moved([&] { running = linear_ != 0 || angular_ != 0; });
    }
    int Move(double distance) override { return MoveWheel(distance, default_velocity); }
    int Rotate(double angle) override { return RotateWheel(angle, default_velocity); }

  protected:
    void configure() override {
        pulses_per_metre_ = 1000 / (M_PI * std::max(1e-3, number_parameter("WheelDiameter", 0.15)));
        half_axle_ = number_parameter("AxleDistance", 0.385) / 2;
        position_ = ObjectLocation();
        left_ = right_ = 0;
        set_motion(0, 0, -1);
    }

  private:
    static constexpr double default_velocity = 0.5; // m/s or rad/s, for calls without a velocity

    /// Advances the base to the present time and calls action().
    template <typename Action>
    int perform_moved(Action action) {
        return perform([&](double, double elapsed) {
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

    ObjectLocation position_;
    double linear_ = 0, angular_ = 0, seconds_left_ = -1;
    double left_ = 0, right_ = 0, pulses_per_metre_ = 0, half_axle_ = 0;
};

} // namespace

TANDEM_DEVICE(WheelController, SimulatedWheelController)
