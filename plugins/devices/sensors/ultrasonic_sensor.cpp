// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/UltrasonicSensor.h>

/// Returns the distance of an object, between 1 and 3 m.
static double echo_distance(int channel, double seconds) {
    return 2 + tandem::devices::sine(channel, seconds);
}

TANDEM_DEVICE(UltrasonicSensor, tandem::devices::FunctionSensor<UltrasonicSensor, double, echo_distance>)
