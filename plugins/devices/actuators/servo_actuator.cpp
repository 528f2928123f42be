// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/actuators/simulated_drive.hpp"

#include <device/ServoActuator.h>

namespace {

using tandem::devices::SimulatedJoint;

/// A drive with velocity and position control.
class SimulatedServoActuator : public tandem::devices::SimulatedDrive<ServoActuator> {
  public:
    /// Reaches the velocity at once and ignores the time.
    int SetVelocity(double velocity, unsigned long) override {
        return with_joint([&](SimulatedJoint& joint) { joint.set_velocity(velocity); });
    }
    int GetVelocity(double& velocity) override {
        return with_joint([&](SimulatedJoint& joint) { velocity = joint.velocity(); });
    }
    /// `time`: milliseconds.
    int SetPosition(double position, unsigned long time) override {
        return with_joint([&](SimulatedJoint& joint) { joint.set_position(position, time); });
    }
    int GetPosition(double& position) override {
        return with_joint([&](SimulatedJoint& joint) { position = joint.position(); });
    }
};

} // namespace

TANDEM_DEVICE(ServoActuator, SimulatedServoActuator)
