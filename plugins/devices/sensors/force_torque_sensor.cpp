// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/ForceTorqueSensor.h>

/// Returns a swinging load of 10 N; N, Nm.
static ForceTorqueSensorData load(int channel, double seconds) {
    const double swing = tandem::devices::sine(channel, seconds);
    return ForceTorqueSensorData(swing, 0, 10, 0, 0, 0.1 * swing);
}

TANDEM_DEVICE(ForceTorqueSensor,
              tandem::devices::FunctionSensor<ForceTorqueSensor, ForceTorqueSensorData, load>)
