// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/devices/actuators/simulated_joint.hpp"
#include "plugins/devices/simulated_device.hpp"

namespace tandem::devices {

/// One drive, for the device classes Actuator and ServoActuator.
template <typename Class>
class SimulatedDrive : public SimulatedDevice<Class> {
  public:
    /// The time that the power is to be reached in is ignored: it is reached at once.
    int SetPower(double power, unsigned long) override {
        return with_joint([&](SimulatedJoint& joint) { joint.set_power(power); });
    }
    int GetPower(double& power) override {
        return with_joint([&](SimulatedJoint& joint) { power = joint.power(); });
    }

  protected:
    /// Calls action(joint) with the lock held, after the joint has moved on to the present time.
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
