// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/actuators/simulated_base.hpp"

#include <device/WheelController.h>

namespace {

/// Drives at a velocity, for a distance or by an angle.
class SimulatedWheelController : public tandem::devices::SimulatedBase<WheelController> {
  public:
    /// Corrects the position, as after localization. The base does not move.
    int SetPosition(ObjectLocation position) override {
        return perform_moved([&] { position_ = position; });
    }
    int GetPosition(ObjectLocation& position) override {
        return perform_moved([&] { position = position_; });
    }
    int GetOdometery(std::vector<long>& pulses) override {
        return perform_moved([&] { pulses = {left_pulses(), right_pulses()}; });
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
        return perform_moved([&] { running = is_moving(); });
    }
    int Move(double distance) override { return MoveWheel(distance, default_velocity); }
    int Rotate(double angle) override { return RotateWheel(angle, default_velocity); }

  private:
    static constexpr double default_velocity = 0.5; // m/s or rad/s, for calls without a velocity
};

} // namespace

TANDEM_DEVICE(WheelController, SimulatedWheelController)
