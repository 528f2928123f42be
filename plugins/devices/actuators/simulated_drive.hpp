// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/devices/actuators/simulated_joint.hpp"
#include "plugins/devices/simulated_device.hpp"

namespace tandem::devices {

/// A drive for the device classes Actuator and ServoActuator.
template <typename Class>
class SimulatedDrive : public SimulatedDevice<Class> {
  public:
    /// Reaches the power at once and ignores the time.
    int SetPower(double power, unsigned long) override {
        return with_joint([&](SimulatedJoint& joint) { joint.set_power(power); });
    }
    int GetPower(double& power) override {
        return with_joint([&](SimulatedJoint& joint) { power = joint.power(); });
    }

  protected:
    /// Advances the joint to the current time and calls action(joint) with the lock held.
    template <typename Action>
    int with_joint(Action action) {
        return this->perform([&](double, double elapsed) {
            joint_.advance(elapsed);
            action(joint_);
        });
    }
    void configure() override { joint_ = SimulatedJoint(); }

  private:
    SimulatedJoint joint_;
};

} // namespace tandem::devices
