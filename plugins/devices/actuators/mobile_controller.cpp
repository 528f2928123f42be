// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/actuators/simulated_base.hpp"

#include <device/MobileController.h>

namespace {

/// Drives at the last velocity until the next. Ignores the velocity to the left, which two wheels cannot reach.
class SimulatedMobileController : public tandem::devices::SimulatedBase<MobileController> {
  public:
    int SetVelocity(OPRoS::MobileVelocityData velocity) override {
        return perform_moved([&] { set_motion(velocity.x, velocity.theta, -1); });
    }
    /// Corrects the position, as after localization. The base does not move.
    int SetPosition(OPRoS::MobilePositionData position) override {
        return perform_moved([&] { position_ = {position.x, position.y, position.theta}; });
    }
    int GetPosition(OPRoS::MobilePositionData& position) override {
        return perform_moved([&] { position = {position_.x, position_.y, position_.theta}; });
    }
    int GetOdometry(std::vector<OPRoS::Int32>& pulses) override {
        return perform_moved([&] {
            pulses = {static_cast<std::int32_t>(left_pulses()), static_cast<std::int32_t>(right_pulses())};
        });
    }
};

} // namespace

TANDEM_DEVICE(MobileController, SimulatedMobileController)
