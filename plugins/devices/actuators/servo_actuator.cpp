// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/actuators/simulated_drive.hpp"

#include <device/ServoActuator.h>

namespace {

using tandem::devices::SimulatedJoint;

class SimulatedServoActuator : public tandem::devices::SimulatedDrive<ServoActuator> {
  public:
    int SetVelocity(double velocity, unsigned long) override {
        return with([&](SimulatedJoint& joint) { joint.set_velocity(velocity); });
    }
    int GetVelocity(double& velocity) override {
        return with([&](SimulatedJoint& joint) { velocity = joint.velocity(); });
    }
    int SetPosition(double position, unsigned long time) override {
        return with([&](SimulatedJoint& joint) { joint.set_position(position, time); });
    }
    int GetPosition(double& position) override {
        return with([&](SimulatedJoint& joint) { position = joint.position(); });
    }
};

} // namespace

TANDEM_DEVICE(SimulatedServoActuator)
