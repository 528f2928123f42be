// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/TorqueSensor.h>

/// Returns up to 1 Nm in both directions.
static double torque(int channel, double seconds) { return tandem::devices::sine(channel, seconds); }

TANDEM_DEVICE(TorqueSensor, tandem::devices::FunctionSensor<TorqueSensor, double, torque>)
