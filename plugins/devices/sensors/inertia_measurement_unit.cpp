// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/InertiaMeasurementUnit.h>

namespace {

/// Turns to and fro on a level floor; rad, rad/s, m/s^2.
class SimulatedInertiaMeasurementUnit
    : public tandem::devices::SimulatedSensor<InertiaMeasurementUnit, ObjectPosture> {
    ObjectPosture at(int channel, double seconds) override {
        ObjectPosture posture;
        posture.yaw = wave(channel, seconds);
        posture.rRate = 0.2 * M_PI * std::cos(0.2 * M_PI * seconds + channel);
        posture.zAcceleration = 9.81;
        return posture;
    }
};

} // namespace

TANDEM_DEVICE(SimulatedInertiaMeasurementUnit)
