// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/devices/actuators/simulated_joint.hpp"
#include "plugins/devices/simulated_device.hpp"

namespace tandem::devices {

/// One drive, for the classes of drives.
template <typename Class>
class SimulatedDrive : public SimulatedDevice<Class> {
  public:
    int SetPower(double power, unsigned long) override {
        return with([&](SimulatedJoint& joint) { joint.set_power(power); });
    }
    int GetPower(double& power) override {
        return with([&](SimulatedJoint& joint) { power = joint.power(); });
    }

  protected:
    template <typename Act>
    int with(Act act) {
        return this->serve([&](double, double elapsed) {
            joint_.advance(elapsed);
            act(joint_);
        });
    }
    void configure() override { joint_ = SimulatedJoint(); }

  private:
    SimulatedJoint joint_;
};

} // namespace tandem::devices
