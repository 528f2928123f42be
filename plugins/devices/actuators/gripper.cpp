// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/actuators/simulated_arm.hpp"

#include <device/Gripper.h>

namespace {

/// A hand that has hold of something from StartGripping() to StopGripping().
class SimulatedGripper : public tandem::devices::SimulatedArm<Gripper> {
  public:
    int StartGripping() override {
        return serve([&](double, double) { gripped_ = true; });
    }
    int StopGripping() override {
        return serve([&](double, double) { gripped_ = false; });
    }
    int IsGripped(bool& gripped) override {
        return serve([&](double, double) { gripped = gripped_; });
    }
    int IsGripped() override {
        bool gripped = false;
        return IsGripped(gripped) == API_SUCCESS ? gripped : API_ERROR;
    }

  private:
    bool gripped_ = false;
};

} // namespace

TANDEM_DEVICE(SimulatedGripper)
