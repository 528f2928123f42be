// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/AccelerationSensor.h>

namespace {

/// Gravity on the third axis, some shaking on the others; m/s^2.
class SimulatedAccelerationSensor : public tandem::devices::SimulatedSensor<AccelerationSensor, double> {
    double at(int channel, double seconds) override {
        return channel % 3 == 2 ? 9.81 : 0.5 * wave(channel, seconds);
    }
};

} // namespace

TANDEM_DEVICE(SimulatedAccelerationSensor)
