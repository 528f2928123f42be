// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/InertiaMeasurementUnit.h>

/// Turns back and forth on a level floor; rad, rad/s, m/s^2.
static ObjectPosture posture(int channel, double seconds) {
    ObjectPosture posture;
    posture.yaw = tandem::devices::sine(channel, seconds);
    posture.rRate = 0.2 * M_PI * std::cos(0.2 * M_PI * seconds + channel); // derivative of yaw
    posture.zAcceleration = 9.81;
    return posture;
}

TANDEM_DEVICE(InertiaMeasurementUnit,
              tandem::devices::FunctionSensor<InertiaMeasurementUnit, ObjectPosture, posture>)
