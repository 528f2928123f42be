// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/actuators/simulated_joint.hpp"

namespace tandem::devices {

// A velocity ends a motion to a position.
void SimulatedJoint::set_velocity(double velocity) {
    velocity_ = velocity;
    seconds_left_ = 0;
}

void SimulatedJoint::set_position(double position, unsigned long milliseconds) {
    target_ = position;
    seconds_left_ = static_cast<double>(milliseconds) / 1000;
    // Constant velocity for the whole motion, without a ramp.
    velocity_ = seconds_left_ > 0 ? (target_ - position_) / seconds_left_ : 0;
    if (milliseconds == 0) position_ = target_;
}

void SimulatedJoint::stop() {
    velocity_ = 0;
    seconds_left_ = 0;
}

void SimulatedJoint::advance(double seconds) {
    if (seconds_left_ > 0 && seconds >= seconds_left_) { // exactly the target, for any time steps
        position_ = target_;
        stop();
        return;
    }
    if (seconds_left_ > 0) seconds_left_ -= seconds;
    position_ += velocity_ * seconds;
}

} // namespace tandem::devices
