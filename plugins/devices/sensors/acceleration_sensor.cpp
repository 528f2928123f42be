// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/AccelerationSensor.h>

namespace {

/// Returns gravity on each third channel and a slow oscillation on the others; m/s^2.
double acceleration(int channel, double seconds) {
    return channel % 3 == 2 ? 9.81 : 0.5 * tandem::devices::sine(channel, seconds);
}
/// Returns the acceleration of a channel of OPRoS v2, which has three axes; m/s^2.
OPRoS::AccelerationSensorData accelerations(int channel, double seconds) {
    const auto axis = [&](int i) { return acceleration(3 * channel + i, seconds); };
    return {axis(0), axis(1), axis(2)};
}

using Accelerometer = tandem::devices::FunctionSensor<AccelerationSensor, double, acceleration>;

} // namespace

TANDEM_DEVICE(
    AccelerationSensor,
    tandem::devices::SensorOfBothVersions<Accelerometer, OPRoS::AccelerationSensorData, accelerations>)
