// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/PositionSensor.h>

/// Drives on a circle of radius 1 m in 10 s, facing forward; m, rad. Channels differ in their heading.
static ObjectPosition position(int channel, double seconds) {
    const double angle = 0.2 * M_PI * seconds;
    return ObjectPosition(std::cos(angle), std::sin(angle), 0, 0, 0, angle + M_PI / 2 + channel);
}

TANDEM_DEVICE(PositionSensor, tandem::devices::FunctionSensor<PositionSensor, ObjectPosition, position>)
