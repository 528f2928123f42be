// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/InfraredSensor.h>

/// Returns the distance of an object, between 0.2 and 0.8 m.
static double distance(int channel, double seconds) {
    return 0.5 + 0.3 * tandem::devices::sine(channel, seconds);
}

TANDEM_DEVICE(InfraredSensor, tandem::devices::FunctionSensor<InfraredSensor, double, distance>)
