// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/actuators/simulated_arm.hpp"

#include <device/Gripper.h>

namespace {

/// A gripper that holds an object from StartGripping() to StopGripping().
class SimulatedGripper : public tandem::devices::SimulatedArm<Gripper> {
  public:
    int StartGripping() override {
        return perform([&] { gripped_ = true; });
    }
    int StopGripping() override {
        return perform([&] { gripped_ = false; });
    }
    int IsGripped(bool& gripped) override {
        return perform([&] { gripped = gripped_; });
    }
    /// Returns 1, 0 or API_ERROR, as in OPRoS v1.
    int IsGripped() override {
        bool gripped = false;
        return IsGripped(gripped) == API_SUCCESS ? gripped : API_ERROR;
    }

  private:
    bool gripped_ = false;
};

} // namespace

TANDEM_DEVICE(Gripper, SimulatedGripper)
