// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/simulated_device.hpp"

#include <device/WheelController.h>

namespace {

/// A base that moves at once as it is told; m, rad, seconds. Its odometers count `WheelDiameter` and
/// `AxleDistance` in 1000 pulses per turn of a wheel.
class SimulatedWheelController : public tandem::devices::SimulatedDevice<WheelController> {
  public:
    int SetPosition(ObjectLocation position) override {
        return driven([&] { position_ = position; });
    }
    int GetPosition(ObjectLocation& position) override {
        return driven([&] { position = position_; });
    }
    int GetOdometery(std::vector<long>& pulses) override {
        return driven([&] { pulses = {std::lround(left_), std::lround(right_)}; });
    }
    int DriveWheel(double linear, double angular) override {
        return driven([&] { go(linear, angular, -1); });
    }
    int MoveWheel(double distance, double linear) override {
        if (linear == 0) return API_ERROR;
        return driven([&] { go(std::copysign(linear, distance), 0, std::fabs(distance / linear)); });
    }
    int RotateWheel(double angle, double angular) override {
        if (angular == 0) return API_ERROR;
        return driven([&] { go(0, std::copysign(angular, angle), std::fabs(angle / angular)); });
    }
    int StopWheel() override {
        return driven([&] { go(0, 0, -1); });
    }
    int IsWheelRunning(bool& running) override {
        return driven([&] { running = linear_ != 0 || angular_ != 0; });
    }
    int Move(double distance) override { return MoveWheel(distance, usual_velocity); }
    int Rotate(double angle) override { return RotateWheel(angle, usual_velocity); }

  protected:
    void configure() override {
        pulses_per_metre_ = 1000 / (M_PI * std::max(1e-3, number("WheelDiameter", 0.15)));
        half_axle_ = number("AxleDistance", 0.385) / 2;
        position_ = ObjectLocation();
        left_ = right_ = 0;
        go(0, 0, -1);
    }

  private:
    static constexpr double usual_velocity = 0.5; // for calls that give none

    template <typename Act>
    int driven(Act act) {
        return serve([&](double, double elapsed) {
            advance(elapsed);
            act();
        });
    }
    /// Seconds below 0: until told otherwise.
    void go(double linear, double angular, double seconds) {
        linear_ = linear;
        angular_ = angular;
        seconds_left_ = seconds;
    }
    void advance(double elapsed) {
        const bool limited = seconds_left_ >= 0;
        const double moved = limited ? std::min(elapsed, seconds_left_) : elapsed;
        position_.x += linear_ * moved * std::cos(position_.theta + angular_ * moved / 2);
        position_.y += linear_ * moved * std::sin(position_.theta + angular_ * moved / 2);
        position_.theta += angular_ * moved;
        left_ += (linear_ - angular_ * half_axle_) * moved * pulses_per_metre_;
        right_ += (linear_ + angular_ * half_axle_) * moved * pulses_per_metre_;
        if (!limited) return;
        seconds_left_ -= moved;
        if (seconds_left_ <= 0) go(0, 0, -1);
    }

    ObjectLocation position_;
    double linear_ = 0, angular_ = 0, seconds_left_ = -1;
    double left_ = 0, right_ = 0, pulses_per_metre_ = 0, half_axle_ = 0;
};

} // namespace

TANDEM_DEVICE(SimulatedWheelController)
