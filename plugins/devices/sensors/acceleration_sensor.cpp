// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/AccelerationSensor.h>

/// Returns gravity on each third channel and a slow oscillation on the others; m/s^2.
static double acceleration(int channel, double seconds) {
    return channel % 3 == 2 ? 9.81 : 0.5 * tandem::devices::sine(channel, seconds);
}

TANDEM_DEVICE(AccelerationSensor, tandem::devices::FunctionSensor<AccelerationSensor, double, acceleration>)
